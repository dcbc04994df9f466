// SPDX-License-Identifier: Apache-2.0
#include "studio/progress_events.hpp"

#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "text/escaped.hpp"

namespace tunica::app::studio {

using json = nlohmann::ordered_json;
using namespace std::chrono_literals;

namespace {

/// The last bytes of a file, from the beginning of a line; empty where there is none.
std::string tail_of(const std::filesystem::path& file, std::streamoff most) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) return {};
  const std::streamoff size = stream.tellg(), from = size > most ? size - most : 0;
  stream.seekg(from);
  std::string text(static_cast<std::size_t>(size - from), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (from > 0 && text.find('\n') != std::string::npos) text.erase(0, text.find('\n') + 1);
  return text::escaped(text, "\n");
}

/// The cells of one row of evaluations.csv, quoted ones as RFC 4180 has them.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

/// evaluations.csv while it grows: whole rows only.
class JournalTail {
 public:
  explicit JournalTail(std::filesystem::path file) : file_(std::move(file)) {}

  /// What came since the last call; null where nothing did.
  json next() {
    std::ifstream stream(file_, std::ios::binary);
    if (!stream || !stream.seekg(read_)) return nullptr;
    json rows = json::array();
    bool news = false;
    for (std::string line; rows.size() < most_rows && std::getline(stream, line) && !stream.eof(); news = true) {
      read_ += static_cast<std::streamoff>(line.size()) + 1;
      take(cells_of(line), rows);
    }
    if (!news) return nullptr;
    return {{"count", count_}, {"rows", std::move(rows)}, {"best", best_}};
  }

 private:
  static constexpr std::size_t most_rows = 2000;

  void take(std::vector<std::string> cells, json& rows) {
    if (names_.empty()) return begin(std::move(cells));
    if (cells.size() != names_.size()) return;  // a row that a crash has damaged
    ++count_;
    const double objective = std::strtod(cells[objective_].c_str(), nullptr);
    if (cells[objective_].empty() || !std::isfinite(objective) || cells[objective_ + 1] != "ok") return;
    const auto [best, first] = best_of_run_.try_emplace(cells[1], objective);
    const bool better = first || objective < best->second;
    if (better) best->second = objective;
    const long evaluation = ++evaluations_[cells[1]];
    const long step = std::max(1L, evaluation / 200);  // of a long search a few hundred points
    if (better || evaluation % step == 0) rows.push_back({evaluation, cells[1], objective});
    if (!best_.is_null() && objective >= best_["objective"].get<double>()) return;
    best_ = {{"run", cells[1]}, {"evaluation", evaluation}, {"objective", objective}, {"parameters", json::object()}};
    for (std::size_t k = 3; k < first_cost_; ++k)
      if (!cells[k].empty()) best_["parameters"][names_[k]] = std::strtod(cells[k].c_str(), nullptr);
  }

  void begin(std::vector<std::string>&& names) {
    names_ = std::move(names);
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (names_[k] == "objective") objective_ = k;
      if (first_cost_ == 0 && (names_[k].starts_with("cost.") || names_[k] == "objective")) first_cost_ = k;
    }
    if (objective_ == 0 || objective_ + 1 >= names_.size()) names_.clear();  // no journal
  }

  std::filesystem::path file_;
  std::streamoff read_ = 0;
  std::vector<std::string> names_;
  std::size_t objective_ = 0, first_cost_ = 0;
  std::uint64_t count_ = 0;
  std::map<std::string, double> best_of_run_;
  std::map<std::string, long> evaluations_;
  json best_ = nullptr;
};

std::string event(const char* kind, const json& data) {
  return fmt::format("event: {}\ndata: {}\n\n", kind, data.dump(-1, ' ', false, json::error_handler_t::replace));
}

struct Stream {
  JobRecord job;
  std::function<std::optional<json>()> ended;
  JournalTail journal;
  std::string said = {};
  bool begun = false, over = false;
  std::chrono::steady_clock::time_point until = std::chrono::steady_clock::now() + 60s, spoke = {};

  std::optional<std::string> next() {
    if (over || std::chrono::steady_clock::now() > until) return std::nullopt;
    if (!begun) {
      begun = true;
      return "retry: 300\n" + event("begin", job.id);
    }
    const auto end = ended();  // before what is read, so that nothing is missed
    json news = journal.next();
    const std::string words = tail_of(job.file(".err"), 2000);
    if (news.is_null() && words != said) news = json::object();
    if (!news.is_null()) {
      spoke = std::chrono::steady_clock::now();
      news["words"] = said = words;
      return event("progress", news);
    }
    if (end) {
      over = true;
      return event("end", *end);
    }
    std::this_thread::sleep_for(100ms);
    if (std::chrono::steady_clock::now() - spoke < 2s) return "";
    spoke = std::chrono::steady_clock::now();
    return ":\n\n";  // a browser that went away is noticed by writing
  }
};

}  // namespace

std::string last_words_of(const JobRecord& job) {
  constexpr std::streamoff most = 8000;
  const std::string out = tail_of(job.file(".out"), most);
  return out + (out.empty() || out.ends_with('\n') ? "" : "\n") + tail_of(job.file(".err"), most);
}

std::function<std::optional<std::string>()> progress_events(const JobRecord& job,
                                                            const std::function<std::optional<json>()>& ended) {
  const std::filesystem::path folder = job.folder;
  auto stream =
      std::make_shared<Stream>(Stream{job, ended, JournalTail(folder.empty() ? folder : folder / "evaluations.csv")});
  return [stream] { return stream->next(); };
}

}  // namespace tunica::app::studio
