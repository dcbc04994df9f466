// SPDX-License-Identifier: Apache-2.0
#include "execution/recovery.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

#include "tunica/error.hpp"

namespace tunica::execution {

void StoredEvaluations::add(const search::JournalEntry& entry) {
  parameters_ = entry.parameters.size();
  tests_ = entry.per_test.size();
  numbers_.insert(numbers_.end(), entry.parameters.begin(), entry.parameters.end());
  numbers_.insert(numbers_.end(), entry.per_test.begin(), entry.per_test.end());
  numbers_.insert(numbers_.end(), {entry.objective, entry.seconds});
  if (!entry.status.ok()) other_than_ok_.emplace(size_, entry.status);
  if (entry.ended_early) ended_early_.insert(size_);
  ++size_;
}

bool StoredEvaluations::get(std::uint64_t index, search::JournalEntry& entry) const {
  if (index >= size_) return false;
  const double* numbers = numbers_.data() + index * (parameters_ + tests_ + 2);
  entry.parameters.assign(numbers, numbers + parameters_);
  entry.per_test.assign(numbers + parameters_, numbers + parameters_ + tests_);
  entry.objective = numbers[parameters_ + tests_];
  entry.seconds = numbers[parameters_ + tests_ + 1];
  const auto other = other_than_ok_.find(index);
  entry.status = other == other_than_ok_.end() ? Status() : other->second;
  entry.ended_early = ended_early_.contains(index);
  return true;
}

namespace {

/// Calls `use` with every complete line and its number until it returns false for a damaged line. Cuts off that line
/// and all later ones, and any text after the last line end. Text that was cut off because of damage is returned and
/// kept in `aside`, because it may be the only evidence of a disk fault.
std::string read_lines(const std::filesystem::path& file, const std::filesystem::path& aside,
                       const std::function<bool(const std::string&, std::size_t)>& use) {
  if (std::error_code unknown; std::filesystem::exists(file, unknown) && !std::filesystem::is_regular_file(file))
    throw InputError(
        fmt::format("{}: this is not a regular file; remove it, or start anew with another -o", file.string()));
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw InputError(
        fmt::format("{}: cannot be read; check its permissions, or start anew with another -o", file.string()));
  std::uintmax_t whole = 0;
  std::string line, damaged;
  for (std::size_t number = 1; std::getline(stream, line) && !stream.eof(); ++number) {
    if (!use(line, number)) {
      damaged = line + '\n' + std::string(std::istreambuf_iterator<char>(stream), {});
      break;
    }
    whole += line.size() + 1;
  }
  stream.close();
  if (std::filesystem::file_size(file) <= whole) return damaged;
  if (!damaged.empty()) {
    AppendFile kept(aside);
    kept.append(damaged);
    kept.sync();
  }
  AppendFile cut(file);
  cut.cut(whole);
  cut.sync();
  return damaged;
}

class Reader {
 public:
  Reader(const EvaluationTable& table, const std::vector<Task>& tasks, const std::vector<bool>& wanted)
      : table_(table), wanted_(wanted) {
    for (std::size_t task = 0; task < tasks.size(); ++task) index_[{tasks[task].run, tasks[task].realisation}] = task;
    result_.stored.rows.assign(tasks.size(), 0);
    result_.evaluations.resize(tasks.size());
  }

  /// Accepts a line; false if its evaluation is already known.
  bool take(const std::string& line, const std::filesystem::path& file, std::size_t number) {
    try {
      table_.parse(line, row_);
      const auto found = index_.find({row_.run, row_.realisation});
      if (found == index_.end()) throw InputError(fmt::format("no realisation {} is planned", row_.realisation));
      const std::size_t task = found->second;
      last_ = task;
      auto& rows = result_.stored.rows[task];
      if (row_.index < rows) return false;
      if (row_.index > rows) throw InputError(fmt::format("id {} follows id {}", row_.index + 1, rows));
      ++rows;
      if (!wanted_[task]) return true;
      table_.values(row_, entry_);
      result_.evaluations[task].add(entry_);
      return true;
    } catch (const InputError& problem) {
      throw InputError(fmt::format("{}:{}: {}. The file was changed since it was written; start anew with another -o",
                                   file.string(), number, problem.what()));
    }
  }

  /// Notes the text that read_lines() cut off after `kept` lines.
  void note(const std::filesystem::path& file, std::size_t kept, const std::string& cut) {
    if (cut.empty()) return;
    const auto lines = std::count(cut.begin(), cut.end(), '\n') + (cut.back() == '\n' ? 0 : 1);
    result_.damages.push_back(
        fmt::format("{}:{}: the row is not what was written; its checksum does not fit. It and what follows, {} rows, "
                    "are in damaged_rows.csv, and are evaluated again",
                    file.string(), kept + 1, lines));
  }

  Recovered& result() { return result_; }
  [[nodiscard]] std::size_t last() const { return last_; }

 private:
  const EvaluationTable& table_;
  const std::vector<bool>& wanted_;
  std::map<std::pair<std::size_t, std::uint64_t>, std::size_t> index_;
  EvaluationTable::Row row_;
  search::JournalEntry entry_;
  Recovered result_;
  std::size_t last_ = 0;
};

}  // namespace

Recovered recover(const std::filesystem::path& directory, const EvaluationTable& table, const std::vector<Task>& tasks,
                  const std::vector<bool>& wanted) {
  static_cast<void>(own_folder(directory / "parts"));
  Reader reader(table, tasks, wanted);
  const auto main = Journal::main_file(directory), aside = directory / "damaged_rows.csv";
  bool has_header = false;
  std::size_t kept = 0;
  const std::string cut = read_lines(main, aside, [&](const std::string& line, std::size_t number) {
    if (number > 1) {
      if (!EvaluationTable::intact(line)) return false;
      reader.take(line, main, number);
      kept = number;
      return true;
    }
    if (line + '\n' != table.header())
      throw InputError(
          fmt::format("{}:1: the columns are not those of this experiment; start anew with another -o", main.string()));
    has_header = true;
    kept = number;
    return true;
  });
  reader.note(main, kept, cut);
  if (!has_header) AppendFile(main).append(table.header());
  const std::size_t head = reader.last();
  for (std::size_t task = 0; task < tasks.size(); ++task) {
    const auto part = Journal::part_file(directory, task);
    if (!std::filesystem::exists(part)) continue;
    std::string missing;
    kept = 0;
    const std::string cut_off = read_lines(part, aside, [&](const std::string& line, std::size_t number) {
      if (!EvaluationTable::intact(line)) return false;
      if (reader.take(line, part, number) && task <= head) missing += line + '\n';
      kept = number;
      return true;
    });
    reader.note(part, kept, cut_off);
    if (task > head) continue;
    AppendFile file(main);
    file.append(missing);
    file.sync();
    std::filesystem::remove(part);
  }
  reader.result().stored.head = head;
  return std::move(reader.result());
}

}  // namespace tunica::execution
