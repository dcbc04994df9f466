// SPDX-License-Identifier: Apache-2.0
#include "studio/workbench.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "assembly/misfit_size.hpp"
#include "assembly/quality.hpp"
#include "calibration/examination.hpp"
#include "calibration/examination_json.hpp"
#include "comparison/stability_report.hpp"
#include "data/nearest.hpp"
#include "execution/files.hpp"
#include "execution/plan.hpp"
#include "experiment/json_document.hpp"
#include "experiment/placed_error.hpp"
#include "serving/served_run.hpp"
#include "studio/confined.hpp"
#include "studio/doorkeeper.hpp"
#include "studio/history.hpp"
#include "studio/project_folder.hpp"
#include "tunica/error.hpp"

namespace tunica::app::studio {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

/// The plan refers to the experiment beside it.
struct Workbench::Open {
  std::string file;
  experiment::Experiment experiment;
  std::vector<std::pair<fs::path, fs::file_time_type>> sources = {};  ///< the file and what it names, as they were read
  execution::Plan plan = {};

  [[nodiscard]] bool is_current() const {
    return std::all_of(sources.begin(), sources.end(), [](const auto& source) {
      std::error_code gone;
      return fs::last_write_time(source.first, gone) == source.second && !gone;
    });
  }
};

namespace {

constexpr std::size_t most_rows = 200000;
constexpr double longest_while_moving = 4;  // ms

/// Row numbers of a channel that are shown: all, or evenly chosen ones with the last.
std::vector<std::size_t> shown_rows(std::size_t count) {
  std::vector<std::size_t> rows;
  const std::size_t shown = std::min(count, most_rows);
  for (std::size_t k = 0; k < shown; ++k) rows.push_back(shown < 2 ? 0 : k * (count - 1) / (shown - 1));
  return rows;
}

template <class Values>
json chosen(const Values& values, const std::vector<std::size_t>& rows) {
  json list = json::array();
  for (const std::size_t row : rows) list.push_back(values[row]);
  return list;
}

json channel_json(const assembly::MeasuredChannel& channel) {
  const auto rows = shown_rows(channel.count);
  const auto& curves = channel.drawn_over.curves;
  std::size_t held_out = 0;
  json breaks = json::array();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    held_out += channel.held_out(rows[k]) ? 1 : 0;
    if (k > 0 && !curves.empty() && curves[rows[k]] != curves[rows[k - 1]]) breaks.push_back(k);
  }
  return {{"test", channel.test},
          {"observable", channel.observable},
          {"unit", channel.unit},
          {"over", channel.drawn_over.name},
          {"over_unit", channel.drawn_over.unit},
          {"rows", channel.count},
          {"x", chosen(channel.drawn_over.values, rows)},
          {"y", chosen(channel.measured, rows)},
          {"held_out", held_out},
          {"breaks", std::move(breaks)}};
}

json run_json(const execution::PlannedRun& run, const std::vector<experiment::RunEntry>& entries) {
  const auto& layout = run.assembly->layout();
  json one = {{"entry", run.entry - entries.data()},
              {"label", run.label},
              {"model", run.entry->model},
              {"optimizer", run.entry->optimizer},
              {"max_evaluations", run.entry->stop.max_evaluations},
              {"costly", layout.has_costly_tests},
              {"parameters", json::array()},
              {"fixed", json::array()},
              {"channels", json::array()}};
  for (const auto& parameter : layout.parameters)
    one["parameters"].push_back({{"name", parameter.name},
                                 {"unit", parameter.unit},
                                 {"min", parameter.min},
                                 {"max", parameter.max},
                                 {"initial", parameter.initial},
                                 {"scale", parameter.scale == Scale::log ? "log" : "linear"}});
  for (const auto& parameter : layout.fixed_parameters)
    one["fixed"].push_back({{"name", parameter.name}, {"unit", parameter.unit}, {"value", parameter.value}});
  for (const auto& channel : layout.channels) one["channels"].push_back(channel_json(channel));
  return one;
}

const execution::PlannedRun& run_of(const execution::Plan& plan, const std::string& label) {
  std::vector<std::string> labels;
  for (const auto& run : plan.runs) {
    if (run.label == label) return run;
    labels.push_back(run.label);
  }
  throw InputError(fmt::format("the experiment has no run '{}'. {}", label, data::suggestion(label, labels)));
}

/// The page evaluates at every move of a slider: nothing of others may be started by that.
void refuse_programs(const experiment::Experiment& experiment) {
  for (const auto& test : experiment.tests)
    if (test.options.has("command") || test.options.has("url"))
      throw InputError(fmt::format(
          "test '{}' starts a program or asks a server, which a slider does not; fit it instead", test.name));
}

/// See Workbench::simulate().
std::string bytes_of(const json& head, const std::vector<float>& values) {
  std::string words = head.dump(-1, ' ', false, json::error_handler_t::replace);
  words.append((4 - words.size() % 4) % 4, ' ');
  const auto length = static_cast<std::uint32_t>(words.size());
  std::string bytes(sizeof length + words.size() + values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  std::memcpy(bytes.data() + sizeof length, words.data(), words.size());
  if (!values.empty())
    std::memcpy(bytes.data() + sizeof length + words.size(), values.data(), values.size() * sizeof(float));
  return bytes;
}

/// Of the text of a file, to detect changes by others.
std::string hash_of(const std::string& text) { return fmt::format("{:016x}", std::hash<std::string>{}(text)); }

/// A text as a file beside another one, where relative names of data begin at the same folder. It goes with this
/// object.
struct Trial {
  fs::path file;
  Trial(const fs::path& beside, const std::string& text) : file(beside.parent_path() / passing_name()) {
    try {
      execution::write_atomically(file, text);
    } catch (const execution::WriteFailure& problem) {
      throw InputError(fmt::format(
          "{}: a text is tried in a file beside this one, and none can be written there; make that folder writable, or "
          "free some space. {}",
          beside.string(), named(problem.what(), "That file")));
    }
  }
  ~Trial() {
    std::error_code none;
    fs::remove(file, none);
  }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;
  /// What is said of it, said of the other file.
  [[nodiscard]] std::string named(std::string words, const std::string& name) const {
    const std::string own = file.string();
    for (auto at = words.find(own); at != std::string::npos; at = words.find(own, at + name.size()))
      words.replace(at, own.size(), name);
    return words;
  }
};

void refuse_other_count(const std::vector<double>& values, const assembly::Assembly& assembly) {
  const std::size_t count = assembly.layout().parameters.size();
  if (values.size() != count)
    throw InputError(fmt::format("the page gives {} values for {} parameters; load it again", values.size(), count));
}

}  // namespace

Workbench::Workbench(const Session& session) : session_(session) {}
Workbench::~Workbench() = default;

std::shared_ptr<const Workbench::Open> Workbench::opened(const std::string& name) {
  constexpr std::size_t most = 6;
  const fs::path file = file_inside(name);
  {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(open_.begin(), open_.end(),
                                    [&](const auto& one) { return one->file == name && one->is_current(); });
    if (found != open_.end()) {
      open_.splice(open_.begin(), open_, found);
      return open_.front();
    }
  }
  std::vector<std::pair<fs::path, fs::file_time_type>> sources{{file, fs::last_write_time(file)}};
  auto open = std::make_shared<Open>(Open{name, read_confined(session_, file), std::move(sources)});
  for (const auto& test : open->experiment.tests)
    for (const fs::path& named : files_of(test)) open->sources.emplace_back(named, fs::last_write_time(named));
  refuse_programs(open->experiment);
  open->plan = execution::make_plan(open->experiment, session_.catalogue());
  if (open->plan.runs.empty())
    throw InputError(fmt::format("{}: there is nothing to fit; give it \"optimizers\" and \"runs\"", name));
  const std::lock_guard lock(mutex_);
  open_.push_front(open);
  if (open_.size() > most) open_.pop_back();
  return open;
}

json Workbench::document(const std::string& name) {
  const fs::path file = file_inside(name);
  const experiment::JsonDocument document(file, execution::read_text(file));
  return {{"document", document.root()},
          {"text", document.text()},
          {"hash", hash_of(document.text())},
          {"commented", json::parse(document.text(), nullptr, false).is_discarded()}};
}

json Workbench::save(const std::string& name, const std::string& hash, const Written& written) {
  const fs::path file = file_inside(name);
  const std::lock_guard one_at_a_time(saving_);
  const json present = Workbench::document(name);
  const bool loses_comments = written.is_document && present["commented"].get<bool>();
  const bool beside = written.as_new || loses_comments || fs::exists(file.parent_path() / "result.json");
  if (!beside && present["hash"] != hash)
    throw Overtaken(fmt::format(
        "{}: the file has changed since the page read it; load the page again, and make the change anew", name));
  const Trial trial(file, written.text);
  try {
    static_cast<void>(read_confined(session_, trial.file));
  } catch (const InputError& problem) {
    throw InputError(trial.named(problem.what(), name));
  }
  std::optional<FreeName> copy;
  if (beside) copy.emplace(file);
  const fs::path target = copy ? copy->file : file;
  fs::rename(trial.file, target);
  if (target != file) note_copy(target.generic_string(), file.generic_string());
  return {{"file", target.generic_string()}};
}

json Workbench::proof(const std::string& name, const std::string& text) const {
  const Trial trial(file_inside(name), text);
  try {
    const auto experiment = calibration::offline(read_confined(session_, trial.file));
    static_cast<void>(execution::make_plan(experiment, session_.catalogue()));
    return {{"error", nullptr}};
  } catch (const experiment::PlacedError& problem) {
    return {{"error", trial.named(problem.what(), name)}, {"line", problem.line}, {"column", problem.column}};
  } catch (const InputError& problem) {
    return {{"error", trial.named(problem.what(), name)}, {"line", nullptr}, {"column", nullptr}};
  }
}

json Workbench::problem(const std::string& name) {
  const auto open = opened(name);
  json problem = {{"name", open->experiment.name}, {"seed", open->experiment.seed}, {"runs", json::array()}};
  for (const auto& run : open->plan.runs) problem["runs"].push_back(run_json(run, open->experiment.runs));
  return problem;
}

std::string Workbench::simulate(const std::string& name, const std::string& label, const std::vector<double>& values) {
  const auto open = opened(name);
  const auto& run = run_of(open->plan, label);
  const auto& layout = run.assembly->layout();
  refuse_other_count(values, *run.assembly);
  const auto begin = std::chrono::steady_clock::now();
  const auto took = [&] {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  };
  try {
    const serving::ServedRun served(*run.assembly);
    const auto predictions = served.values(serving::ServedRun::Function::predictions, values);
    json answer = {{"rows", json::array()}, {"objective", nullptr}, {"quality", json::array()}};
    if (took() < longest_while_moving)  // it is simulated again
      answer["objective"] = served.values(serving::ServedRun::Function::objective, values).front().front();
    std::vector<double> all;
    std::vector<float> shown;
    for (const auto& channel : predictions) {
      const auto rows = shown_rows(channel.size());
      answer["rows"].push_back(rows.size());
      for (const std::size_t row : rows) shown.push_back(static_cast<float>(channel[row]));
      all.insert(all.end(), channel.begin(), channel.end());
    }
    const auto ranges = assembly::observable_ranges(layout, open->experiment);
    const auto quality = assembly::quality(*run.assembly, all);
    for (std::size_t k = 0; k < quality.size(); ++k) {
      const auto& agreement = quality[k].fitted ? quality[k].fitted : quality[k].held_out;
      json one = nullptr;
      if (agreement)
        one = {{"rmse", agreement->rmse},
               {"r2", agreement->r2 ? json(*agreement->r2) : json(nullptr)},
               {"share", agreement->rmse / ranges[k]}};
      answer["quality"].push_back(std::move(one));
    }
    answer["milliseconds"] = took();
    return bytes_of(answer, shown);
  } catch (const serving::ModelFailure& failure) {
    return bytes_of({{"failed", failure.what()}}, {});
  }
}

json Workbench::judge(const std::string& name, const std::string& label, const std::vector<double>& values) {
  const auto open = opened(name);
  const auto& run = run_of(open->plan, label);
  refuse_other_count(values, *run.assembly);
  const auto found = comparison::stability_of(*run.assembly, values, {});
  json sentences = json::array();
  for (const auto& model : found.models)
    for (const auto& sentence : model.verdict.sentences())
      sentences.push_back(found.models.size() > 1 ? fmt::format("{}: {}", model.name, sentence) : sentence);
  const auto stable = found.transversely_stable();
  json objective = nullptr;
  try {
    const serving::ServedRun served(*run.assembly);
    objective = served.values(serving::ServedRun::Function::objective, values).front().front();
  } catch (const serving::ModelFailure&) {  // simulate() says why
  }
  return {{"stable", stable ? json(*stable) : json(nullptr)},
          {"sentences", std::move(sentences)},
          {"objective", std::move(objective)}};
}

json Workbench::check(const std::string& name) {
  const auto experiment = calibration::offline(read_confined(session_, file_inside(name)));
  return calibration::examination_json(calibration::examine(experiment, session_.catalogue()));
}

}  // namespace tunica::app::studio
