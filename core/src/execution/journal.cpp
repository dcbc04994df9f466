// SPDX-License-Identifier: Apache-2.0
#include "execution/journal.hpp"

#include <system_error>
#include <utility>

namespace tunica::execution {

namespace {
constexpr std::size_t buffered_bytes = 1 << 16;
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
  const std::lock_guard lock(sink.mutex);
  if (record.index < sink.next || failed()) return;
  sink.next = record.index + 1;
  table_.append_row(sink.rows, tasks_[task].run, tasks_[task].realisation, record);
  if (sink.rows.size() < buffered_bytes) return;
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
  for (std::size_t task = 0; task < sinks_.size(); ++task) {
    Sink& sink = *sinks_[task];
    const std::lock_guard lock(sink.mutex);
    if (sink.rows.size() == 0) continue;
    write(task, {sink.rows.data(), sink.rows.size()});
    sink.rows.clear();
  }
  if (!durable) return;
  const std::lock_guard lock(files_);
  keep_failure([&] {
    main_.sync();
    for (const auto& sink : sinks_) sink->part.sync();
  });
}

void Journal::finish(std::size_t task) {
  Sink& sink = *sinks_[task];
  const std::lock_guard lock(sink.mutex);
  if (sink.rows.size() > 0) write(task, {sink.rows.data(), sink.rows.size()});
  sink.rows.clear();
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
