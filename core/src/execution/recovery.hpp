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

/// The evaluations of one realisation, read back: what its optimiser was answered so far.
class StoredEvaluations {
 public:
  void add(const search::JournalEntry& entry);
  /// False when there is none at this index; see search::Replay.
  bool get(std::uint64_t index, search::JournalEntry& entry) const;
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  std::size_t parameters_ = 0, tests_ = 0;
  std::uint64_t size_ = 0;
  std::vector<double> numbers_;  ///< parameters, costs, objective, seconds of each evaluation
  std::map<std::uint64_t, Status> other_than_ok_;
  std::unordered_set<std::uint64_t> ended_early_;
};

/// What the journal of a killed run holds. Reading repairs it: a torn last line is cut off, and rows that were being
/// moved to evaluations.csv are moved to the end. A row whose checksum does not fit is cut off with all that follow it:
/// the searches make them again, since what stands before decides them.
struct Recovered {
  std::vector<std::string> damages;  ///< sentences for the user: which row, and what becomes of it
  Journal::Stored stored;
  std::vector<StoredEvaluations> evaluations;  ///< per task; empty where not wanted
};

/// `wanted` says for which tasks the evaluations are needed; the others are only counted. Throws InputError when the
/// files are not the journal of these tasks (file and line in the message).
Recovered recover(const std::filesystem::path& directory, const EvaluationTable& table, const std::vector<Task>& tasks,
                  const std::vector<bool>& wanted);

}  // namespace tunica::execution
