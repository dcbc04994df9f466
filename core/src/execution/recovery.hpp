// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_set>
#include <vector>

#include "execution/journal.hpp"

namespace tunica::execution {

/// The evaluations of one realisation, read back: the values that its optimiser received so far.
class StoredEvaluations {
 public:
  void add(const search::JournalEntry& entry);
  /// False if there is no entry at this index; see search::Replay.
  bool get(std::uint64_t index, search::JournalEntry& entry) const;
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  std::size_t parameters_ = 0, tests_ = 0;
  std::uint64_t size_ = 0;
  std::vector<double> numbers_;  ///< parameters, costs, objective, seconds of each evaluation
  std::map<std::uint64_t, Status> other_than_ok_;
  std::unordered_set<std::uint64_t> ended_early_;
};

/// The journal of a killed run. Reading repairs it: an incomplete last line is cut off, and an unfinished move of rows
/// to evaluations.csv is completed. A row with a wrong checksum is cut off with all later rows. The searches make these
/// rows again, since the earlier rows determine them.
struct Recovered {
  std::vector<std::string> damages;  ///< sentences for the user: which row, and what is done about it
  Journal::Stored stored;
  std::vector<StoredEvaluations> evaluations;  ///< per task; empty where not wanted
};

/// `wanted` selects the tasks whose evaluations are needed; those of other tasks are only counted. Throws InputError,
/// with file and line, if the files are not the journal of these tasks.
Recovered recover(const std::filesystem::path& directory, const EvaluationTable& table, const std::vector<Task>& tasks,
                  const std::vector<bool>& wanted);

}  // namespace tunica::execution
