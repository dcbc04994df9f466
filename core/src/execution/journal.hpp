// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "execution/evaluation_table.hpp"
#include "execution/files.hpp"

namespace tunica::execution {

/// One realisation of one run, the unit that is started, finished and resumed. `realisation` counts from 1.
struct Task {
  std::size_t run = 0;
  std::uint64_t realisation = 1;
};

/// evaluations.csv while a run is under way, and with it the memory that a killed run is resumed from.
///
/// Why a journal of evaluations is a checkpoint of any optimiser: given its seed, an optimiser is a deterministic
/// function of the answers it gets. Started again and answered from the journal it passes through the same states
/// without one new evaluation, and goes on where it was killed; no optimiser has to know how to save itself.
///
/// The rows of evaluations.csv are in the order of run, realisation, id, whatever the number of threads: the first
/// unfinished realisation appends to it; those that run ahead of it append to `parts/<n>.csv` and are moved over
/// when their turn comes. Rows are buffered as numbers; flush() makes text of them and is to be called every 0.2 s or
/// less. A search does that by itself only once `most_pending` rows wait. A failed write is kept in
/// failure() and stops the recording, for it happens inside an optimiser, where no exception of ours belongs.
/// Threads: one task's record() from one thread at a time; everything else from any.
class Journal {
 public:
  /// What is on disk already: rows of each task, in order from index 0.
  struct Stored {
    std::vector<std::uint64_t> rows;  ///< per task; empty = a new journal
    std::size_t head = 0;             ///< task whose rows end evaluations.csv
  };

  Journal(std::filesystem::path directory, const EvaluationTable& table, std::vector<Task> tasks, Stored stored);
  ~Journal();

  /// Appends a row; rows that are stored already are passed over.
  void record(std::size_t task, const search::Record& record);
  /// Rows that wait before the search that records them has to write them; fewer where many searches share the memory.
  void let_wait(std::size_t rows) { most_pending_ = rows; }
  /// These realisations have ended. Once it returns, a checkpoint may count on their rows.
  void finish(std::span<const std::size_t> tasks);
  void finish(std::size_t task) { finish(std::span(&task, 1)); }
  /// Writes what is buffered; `durable` waits until it is on the disk.
  void flush(bool durable = false);

  [[nodiscard]] bool failed() const { return failed_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::string failure() const;

  static std::filesystem::path main_file(const std::filesystem::path& directory);
  static std::filesystem::path part_file(const std::filesystem::path& directory, std::size_t task);

 private:
  /// Rows of one task that are no text yet.
  struct Pending {
    std::vector<double> numbers;  ///< of each row its parameters, costs, objective and seconds
    std::vector<std::pair<std::size_t, Status>> other_than_ok;
    std::vector<std::uint64_t> indices;
    std::vector<char> ended_early;

    void add(const search::Record& record);
    void clear();
  };
  struct alignas(128) Sink {  // of one search: no cache line in common with another one
    std::mutex order;         ///< of what becomes text and is written, so that rows keep their order; taken first
    std::mutex mutex;         ///< of `pending` and `next`
    Pending pending;
    Pending formatted;        ///< being written; under `order`
    fmt::memory_buffer rows;  ///< text that is not written yet; under `order`
    std::uint64_t next = 0;   ///< index of the first row that is not stored
    AppendFile part;          ///< under `order`
    std::atomic<bool> finished = false;
  };
  enum class Wait { no, yes };
  /// Makes text of what is pending and writes it; without waiting for a file that another thread writes, text stays in
  /// memory, up to a bound. Under the order of the sink.
  void drain(std::size_t task, Wait wait);
  void write(std::size_t task, Wait wait);
  void advance();
  template <class Action>
  bool keep_failure(Action&& action);

  std::filesystem::path directory_;
  const EvaluationTable& table_;
  std::vector<Task> tasks_;
  std::vector<std::unique_ptr<Sink>> sinks_;
  std::mutex turn_;       ///< of advance()
  std::mutex main_file_;  ///< of `main_`; taken after the order of a sink
  AppendFile main_;
  std::atomic<std::size_t> head_ = 0;  ///< becomes a task under the order of that task's sink
  mutable std::mutex words_;           ///< of `failure_`
  std::string failure_;
  std::atomic<bool> failed_ = false;
  std::size_t most_pending_ = 512;
};

}  // namespace tunica::execution
