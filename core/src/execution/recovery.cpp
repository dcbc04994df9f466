// SPDX-License-Identifier: Apache-2.0
#include "execution/recovery.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
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
  return true;
}

namespace {

/// Calls `use` with every whole line and its number, and cuts off what follows the last line end.
void read_lines(const std::filesystem::path& file, const std::function<void(const std::string&, std::size_t)>& use) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw InputError(
        fmt::format("{}: cannot be read; check its permissions, or start anew with another -o", file.string()));
  std::uintmax_t whole = 0;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line) && !stream.eof(); ++number) {
    whole += line.size() + 1;
    use(line, number);
  }
  stream.close();
  if (std::filesystem::file_size(file) > whole) std::filesystem::resize_file(file, whole);
}

class Reader {
 public:
  Reader(const EvaluationTable& table, const std::vector<Task>& tasks, const std::vector<bool>& wanted)
      : table_(table), wanted_(wanted) {
    for (std::size_t task = 0; task < tasks.size(); ++task) index_[{tasks[task].run, tasks[task].realisation}] = task;
    result_.stored.rows.assign(tasks.size(), 0);
    result_.evaluations.resize(tasks.size());
  }

  /// Takes a line over; false when its evaluation is known already.
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
  Reader reader(table, tasks, wanted);
  const auto main = Journal::main_file(directory);
  bool has_header = false;
  read_lines(main, [&](const std::string& line, std::size_t number) {
    if (number > 1) {
      reader.take(line, main, number);
      return;
    }
    if (line + '\n' != table.header())
      throw InputError(
          fmt::format("{}:1: the columns are not those of this experiment; start anew with another -o", main.string()));
    has_header = true;
  });
  if (!has_header) AppendFile(main).append(table.header());
  const std::size_t head = reader.last();
  for (std::size_t task = 0; task < tasks.size(); ++task) {
    const auto part = Journal::part_file(directory, task);
    if (!std::filesystem::exists(part)) continue;
    std::string missing;
    read_lines(part, [&](const std::string& line, std::size_t number) {
      if (reader.take(line, part, number) && task <= head) missing += line + '\n';
    });
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
