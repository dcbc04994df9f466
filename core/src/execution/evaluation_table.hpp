// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "search/calibration_problem.hpp"

namespace tunica::execution {

/// The columns of one run in evaluations.csv.
struct RunColumns {
  std::string label;                                            ///< "gho/es"
  std::vector<std::pair<std::string, std::string>> parameters;  ///< name, base unit
  std::vector<std::string> tests;
};

/// The layout of evaluations.csv: one file for all runs, one row an evaluation.
///
///   id, run, realisation, <parameter> [unit] …, cost.<test> …, objective, status, violation, reason, time [s],
///   checksum
///
/// Parameter and cost columns are the union over the runs, in order of first appearance; a cell is empty if its run
/// lacks the column. id counts from 1 within a realisation, and time from its beginning. checksum covers the text
/// before it in the line (checksum.hpp). A number is the shortest text that reads back as the same double, because a
/// run resumes from this file bit for bit.
class EvaluationTable {
 public:
  explicit EvaluationTable(std::vector<RunColumns> runs);

  [[nodiscard]] std::string header() const;  ///< with its line end
  [[nodiscard]] const std::vector<RunColumns>& runs() const { return runs_; }

  /// Appends one line. Well under a microsecond; allocates only when the buffer grows.
  void append_row(fmt::memory_buffer& buffer, std::size_t run, std::uint64_t realisation,
                  const search::Record& record) const;

  struct Row {
    std::size_t run = 0;
    std::uint64_t realisation = 0, index = 0;  ///< index from 0, as in Record
    std::vector<std::string_view> cells;       ///< of the line that was parsed
  };
  /// Whether a line is exactly one that append_row wrote.
  static bool intact(std::string_view line);
  /// Splits a line and reads the index of its evaluation. Throws InputError for a line that this layout cannot have
  /// written. `values` then reads the rest.
  void parse(std::string_view line, Row& row) const;
  void values(const Row& row, search::JournalEntry& entry) const;

 private:
  std::vector<RunColumns> runs_;
  std::vector<std::string> quoted_labels_;
  std::vector<std::string> parameter_columns_, cost_columns_;
  std::vector<std::vector<int>> parameter_slots_, cost_slots_;  ///< run → column → own index, or -1
};

}  // namespace tunica::execution
