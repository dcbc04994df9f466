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
  if (tasks_.size() > 1) make_folder(own_folder(directory_ / "parts"));
}

Journal::~Journal() {
  std::error_code ignored;
  std::filesystem::remove(directory_ / "parts", ignored);  // only when nothing is left in it
}

template <class Action>
bool Journal::keep_failure(Action&& action) {
  try {
    action();
    return true;
  } catch (const std::exception& problem) {
    const std::lock_guard lock(words_);
    if (!failed_.exchange(true)) failure_ = problem.what();
    return false;
  }
}

std::string Journal::failure() const {
  const std::lock_guard lock(words_);
  return failure_;
}

// A search does not wait while its rows are written or merged: they wait, until they are too many.
void Journal::record(std::size_t task, const search::Record& record) {
  constexpr std::size_t patience = 16;
  Sink& sink = *sinks_[task];
  std::size_t pending;
  {
    const std::lock_guard lock(sink.mutex);
    if (record.index < sink.next || failed()) return;
    sink.next = record.index + 1;
    sink.pending.add(record);
    pending = sink.pending.indices.size();
  }
  if (pending < most_pending_) return;
  std::unique_lock order(sink.order, std::try_to_lock);
  if (!order.owns_lock()) {
    if (pending < patience * most_pending_) return;
    order.lock();
  }
  drain(task, Wait::no);
}

void Journal::drain(std::size_t task, Wait wait) {
  Sink& sink = *sinks_[task];
  {
    const std::lock_guard lock(sink.mutex);
    std::swap(sink.pending, sink.formatted);
  }
  Pending& rows = sink.formatted;
  const auto [run, realisation] = tasks_[task];
  const std::size_t each = rows.indices.empty() ? 0 : rows.numbers.size() / rows.indices.size();
  const std::size_t tests = table_.runs()[run].tests.size();
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
  write(task, wait);
}

void Journal::write(std::size_t task, Wait wait) {
  constexpr std::size_t most_text = 1 << 22;
  Sink& sink = *sinks_[task];
  if (sink.rows.size() == 0) return;
  if (!failed() && task == head_) {
    std::unique_lock file(main_file_, std::defer_lock);
    if (wait == Wait::yes || sink.rows.size() > most_text)
      file.lock();
    else if (!file.try_lock())
      return;
    keep_failure([&] { main_.append({sink.rows.data(), sink.rows.size()}); });
  } else if (!failed()) {
    keep_failure([&] {
      if (!sink.part.is_open()) sink.part = AppendFile(part_file(directory_, task));
      sink.part.append({sink.rows.data(), sink.rows.size()});
    });
  }
  sink.rows.clear();
}

void Journal::flush(bool durable) {
  for (std::size_t task = 0; task < sinks_.size(); ++task) {
    const std::lock_guard order(sinks_[task]->order);
    drain(task, Wait::yes);
    if (durable) keep_failure([&] { sinks_[task]->part.sync(); });
  }
  if (!durable) return;
  const std::lock_guard file(main_file_);
  keep_failure([&] { main_.sync(); });
}

void Journal::finish(std::span<const std::size_t> tasks) {
  for (const std::size_t task : tasks) {
    const std::lock_guard order(sinks_[task]->order);
    drain(task, Wait::yes);
    sinks_[task]->finished = true;
  }
  advance();
  for (const std::size_t task : tasks) {  // those that are not merged yet: before a checkpoint counts on their rows
    const std::lock_guard order(sinks_[task]->order);
    if (failed() || task <= head_) continue;
    keep_failure([&] {
      sinks_[task]->part.sync();
      sinks_[task]->part.close();
    });
  }
}

/// Lets the next unfinished realisation append to evaluations.csv, after the rows of those that were ahead of it. One
/// wait for the disk serves all of them.
/// A crash between copying a part and removing it leaves rows twice; recovery knows them by their id.
void Journal::advance() {
  const std::lock_guard turn(turn_);
  if (failed()) return;
  keep_failure([&] {
    std::vector<std::filesystem::path> merged;
    while (head_ + 1 < sinks_.size() && sinks_[head_]->finished && !failed()) {
      const std::size_t next = head_ + 1;
      const std::lock_guard order(sinks_[next]->order);
      const auto part = part_file(directory_, next);
      sinks_[next]->part.close();
      if (std::filesystem::exists(part)) {
        const std::string rows = read_text(part);
        const std::lock_guard file(main_file_);
        main_.append(rows);
        merged.push_back(part);
      }
      head_ = next;
    }
    const std::lock_guard file(main_file_);
    main_.sync();
    for (const auto& part : merged) std::filesystem::remove(part);
  });
}

}  // namespace tunica::execution
