// SPDX-License-Identifier: Apache-2.0
#include "execution/journal.hpp"

#include <span>
#include <system_error>
#include <utility>

namespace tunica::execution {

void Journal::Pending::add(const search::Record& record) {
  if (!record.status.ok()) other_than_ok.emplace_back(indices.size(), record.status);
  indices.push_back(record.index);
  ended_early.push_back(record.ended_early ? 1 : 0);
  numbers.insert(numbers.end(), record.parameters.begin(), record.parameters.end());
  numbers.insert(numbers.end(), record.per_test.begin(), record.per_test.end());
  numbers.insert(numbers.end(), {record.objective, record.seconds});
}

void Journal::Pending::clear() {
  numbers.clear();
  other_than_ok.clear();
  indices.clear();
  ended_early.clear();
}

std::filesystem::path Journal::main_file(const std::filesystem::path& directory) {
  return directory / "evaluations.csv";
}

std::filesystem::path Journal::part_file(const std::filesystem::path& directory, std::size_t task) {
  return directory / "parts" / fmt::format("{}.csv", task + 1);
}

Journal::Journal(std::filesystem::path directory, const EvaluationTable& table, std::vector<Task> tasks, Stored stored)
    : directory_(std::move(directory)), table_(table), tasks_(std::move(tasks)), head_(stored.head) {
  for (std::size_t task = 0; task < tasks_.size(); ++task) {
    sinks_.push_back(std::make_unique<Sink>());
    if (task < stored.rows.size()) sinks_.back()->next = stored.rows[task];
  }
  main_ = AppendFile(main_file(directory_));
  if (stored.rows.empty()) main_.append(table_.header());
  main_.sync();
  if (tasks_.size() > 1) make_folder(directory_ / "parts");
}

Journal::~Journal() {
  std::error_code ignored;
  std::filesystem::remove(directory_ / "parts", ignored);  // only when nothing is left in it
}

template <class Action>
void Journal::keep_failure(Action&& action) {
  try {
    action();
  } catch (const std::exception& problem) {
    if (!failed_.exchange(true)) failure_ = problem.what();
  }
}

std::string Journal::failure() const {
  const std::lock_guard lock(files_);
  return failure_;
}

void Journal::record(std::size_t task, const search::Record& record) {
  Sink& sink = *sinks_[task];
  {
    const std::lock_guard lock(sink.mutex);
    if (record.index < sink.next || failed()) return;
    sink.next = record.index + 1;
    sink.pending.add(record);
    if (sink.pending.indices.size() < most_pending_) return;
  }
  drain(task);
}

void Journal::drain(std::size_t task) {
  Sink& sink = *sinks_[task];
  const std::lock_guard order(sink.order);
  {
    const std::lock_guard lock(sink.mutex);
    std::swap(sink.pending, sink.formatted);
  }
  Pending& rows = sink.formatted;
  if (rows.indices.empty()) return;
  const auto [run, realisation] = tasks_[task];
  const std::size_t each = rows.numbers.size() / rows.indices.size(), tests = table_.runs()[run].tests.size();
  const std::size_t parameters = each - tests - 2;
  const Status ok;
  auto other = rows.other_than_ok.begin();
  for (std::size_t k = 0; k < rows.indices.size(); ++k) {
    const auto numbers = std::span<const double>(rows.numbers).subspan(k * each, each);
    const bool is_other = other != rows.other_than_ok.end() && other->first == k;
    table_.append_row(
        sink.rows, run, realisation,
        {rows.indices[k], numbers.first(parameters), numbers[each - 2], numbers.subspan(parameters, tests),
         is_other ? other->second : ok, numbers[each - 1], rows.ended_early[k] != 0});
    if (is_other) ++other;
  }
  rows.clear();
  write(task, {sink.rows.data(), sink.rows.size()});
  sink.rows.clear();
}

void Journal::write(std::size_t task, std::string_view rows) {
  const std::lock_guard lock(files_);
  if (failed()) return;
  keep_failure([&] {
    if (task == head_) {
      main_.append(rows);
      return;
    }
    Sink& sink = *sinks_[task];
    if (!sink.part.is_open()) sink.part = AppendFile(part_file(directory_, task));
    sink.part.append(rows);
  });
}

void Journal::flush(bool durable) {
  for (std::size_t task = 0; task < sinks_.size(); ++task) drain(task);
  if (!durable) return;
  const std::lock_guard lock(files_);
  keep_failure([&] {
    main_.sync();
    for (const auto& sink : sinks_) sink->part.sync();
  });
}

void Journal::finish(std::size_t task) {
  drain(task);
  Sink& sink = *sinks_[task];
  const std::lock_guard order(sink.order);
  const std::lock_guard files_lock(files_);
  sink.finished = true;
  if (failed()) return;
  keep_failure([&] {
    sink.part.sync();  // before a checkpoint counts on its rows
    sink.part.close();
    advance();
  });
}

/// Lets the next unfinished realisation append to evaluations.csv, after the rows of those that were ahead of it.
/// A crash between copying a part and removing it leaves rows twice; recovery knows them by their id.
void Journal::advance() {
  while (head_ + 1 < sinks_.size() && sinks_[head_]->finished) {
    ++head_;
    const auto part = part_file(directory_, head_);
    sinks_[head_]->part.close();
    if (!std::filesystem::exists(part)) continue;
    main_.append(read_text(part));
    main_.sync();
    std::filesystem::remove(part);
  }
}

}  // namespace tunica::execution
