// SPDX-License-Identifier: Apache-2.0
#include "execution/evaluation_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/compile.h>

#include "execution/checksum.hpp"
#include "text/csv.hpp"
#include "tunica/error.hpp"

namespace tunica::execution {

using text::csv_cell;

namespace {

constexpr std::size_t fixed_before = 3;  // id, run, realisation
constexpr std::size_t fixed_after = 6;   // objective, status, violation, reason, time, checksum

/// The columns of all runs, each once, in order of first appearance, and the positions of each run's columns.
void unite(const std::vector<std::vector<std::string>>& per_run, std::vector<std::string>& columns,
           std::vector<std::vector<int>>& slots) {
  for (const auto& names : per_run)
    for (const auto& name : names)
      if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
  for (const auto& names : per_run) {
    auto& slot = slots.emplace_back(columns.size(), -1);
    for (std::size_t own = 0; own < names.size(); ++own) {
      const auto column = std::find(columns.begin(), columns.end(), names[own]) - columns.begin();
      slot[static_cast<std::size_t>(column)] = static_cast<int>(own);
    }
  }
}

constexpr std::string_view ended_early = "ended_early";  // stands in the column "status"

constexpr std::size_t longest_number = 26;  // "-1.7976931348623157e+308,", the longest double with its comma, has 25

char* put(char* at, std::string_view text) { return std::copy(text.begin(), text.end(), at); }

char* put_number(char* at, double value) {
  return std::isfinite(value) ? fmt::format_to(at, FMT_COMPILE("{}"), value) : at;
}

template <class Number>
Number read_number(std::string_view cell, Number when_empty) {
  if (cell.empty()) return when_empty;
  Number value{};
  const auto end = cell.data() + cell.size();
  const auto [stop, error] = std::from_chars(cell.data(), end, value);
  if (error != std::errc{} || stop != end) throw InputError(fmt::format("'{}' is not a number", cell));
  return value;
}

std::string unquoted(std::string_view cell) {
  if (cell.size() < 2 || cell.front() != '"') return text::cell_text(cell);
  std::string text;
  for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
    text += cell[i];
    if (cell[i] == '"') ++i;
  }
  return text::cell_text(text);
}

void split(std::string_view line, std::vector<std::string_view>& cells) {
  cells.clear();
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] != ',' || quoted) continue;
    cells.push_back(line.substr(begin, i - begin));
    begin = i + 1;
  }
  cells.push_back(line.substr(begin));
}

}  // namespace

EvaluationTable::EvaluationTable(std::vector<RunColumns> runs) : runs_(std::move(runs)) {
  std::vector<std::vector<std::string>> parameters, costs;
  for (const auto& run : runs_) {
    quoted_labels_.push_back(csv_cell(run.label));
    auto& names = parameters.emplace_back();
    for (const auto& [name, unit] : run.parameters) names.push_back(fmt::format("{} [{}]", name, unit));
    auto& tests = costs.emplace_back();
    for (const auto& test : run.tests) tests.push_back("cost." + test);
  }
  unite(parameters, parameter_columns_, parameter_slots_);
  unite(costs, cost_columns_, cost_slots_);
}

std::string EvaluationTable::header() const {
  std::string line = "id,run,realisation";
  for (const auto& column : parameter_columns_) line += ',' + csv_cell(column);
  for (const auto& column : cost_columns_) line += ',' + csv_cell(column);
  return line + ",objective,status,violation,reason,time [s],checksum\n";
}

void EvaluationTable::append_row(fmt::memory_buffer& buffer, std::size_t run, std::uint64_t realisation,
                                 const search::Record& record) const {
  const std::string reason = record.status.reason().empty() ? std::string() : csv_cell(record.status.reason());
  const std::size_t numbers = parameter_columns_.size() + cost_columns_.size() + fixed_before + fixed_after;
  // It reserves room for the longest line and then writes by pointer: a fifth faster than appending piece by piece.
  const std::size_t before = buffer.size();
  buffer.resize(before + numbers * longest_number + quoted_labels_[run].size() + reason.size());
  char* at = buffer.data() + before;
  at = fmt::format_to(at, FMT_COMPILE("{},{},{}"), record.index + 1, quoted_labels_[run], realisation);
  const bool failed = record.status.kind() == Status::Kind::failed;
  for (const int own : parameter_slots_[run]) {
    *at++ = ',';
    if (own >= 0) at = put_number(at, record.parameters[static_cast<std::size_t>(own)]);
  }
  for (const int own : cost_slots_[run]) {
    *at++ = ',';
    if (own >= 0 && !failed) at = put_number(at, record.per_test[static_cast<std::size_t>(own)]);
  }
  *at++ = ',';
  if (!failed) at = put_number(at, record.objective);
  *at++ = ',';
  at = put(at, record.ended_early ? ended_early : name(record.status.kind()));
  *at++ = ',';
  if (record.status.kind() == Status::Kind::infeasible) at = put_number(at, record.status.violation());
  *at++ = ',';
  at = put(at, reason);
  // Microseconds, written as a decimal fraction: cheaper than printing a double with a precision.
  const auto micro = static_cast<std::uint64_t>(std::max(0.0, record.seconds) * 1e6);
  at = fmt::format_to(at, FMT_COMPILE(",{}.{:06}"), micro / 1000000, micro % 1000000);
  const std::string_view cells(buffer.data() + before, static_cast<std::size_t>(at - buffer.data()) - before);
  *at++ = ',';
  at = put_checksum(at, cells);
  *at++ = '\n';
  buffer.resize(static_cast<std::size_t>(at - buffer.data()));
}

bool EvaluationTable::intact(std::string_view line) {
  if (line.size() <= checksum_digits) return false;
  const std::size_t cells = line.size() - checksum_digits - 1;
  return line[cells] == ',' && line.substr(cells + 1) == checksum(line.substr(0, cells));
}

void EvaluationTable::parse(std::string_view line, Row& row) const {
  split(line, row.cells);
  const std::size_t expected = fixed_before + parameter_columns_.size() + cost_columns_.size() + fixed_after;
  if (row.cells.size() != expected)
    throw InputError(fmt::format("{} cells where the header has {}: '{}'", row.cells.size(), expected, line));
  const auto label = std::find(quoted_labels_.begin(), quoted_labels_.end(), row.cells[1]);
  if (label == quoted_labels_.end())
    throw InputError(fmt::format("'{}' is not a run of this experiment: '{}'", row.cells[1], line));
  row.run = static_cast<std::size_t>(label - quoted_labels_.begin());
  row.realisation = read_number<std::uint64_t>(row.cells[2], 0);
  const auto id = read_number<std::uint64_t>(row.cells[0], 0);
  if (id == 0) throw InputError(fmt::format("no id: '{}'", line));
  row.index = id - 1;
}

void EvaluationTable::values(const Row& row, search::JournalEntry& entry) const {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto& run = runs_[row.run];
  entry.parameters.assign(run.parameters.size(), none);
  entry.per_test.assign(run.tests.size(), none);
  std::size_t cell = fixed_before;
  for (const int own : parameter_slots_[row.run]) {
    if (own >= 0) entry.parameters[static_cast<std::size_t>(own)] = read_number(row.cells[cell], none);
    ++cell;
  }
  for (const int own : cost_slots_[row.run]) {
    if (own >= 0) entry.per_test[static_cast<std::size_t>(own)] = read_number(row.cells[cell], none);
    ++cell;
  }
  entry.objective = read_number(row.cells[cell], none);
  const std::string_view word = row.cells[cell + 1];
  std::string reason = unquoted(row.cells[cell + 3]);
  entry.ended_early = word == ended_early;
  if (word == "ok" || entry.ended_early)
    entry.status = Status();
  else if (word == "infeasible")
    entry.status = Status::infeasible(std::move(reason), read_number(row.cells[cell + 2], none));
  else if (word == "failed")
    entry.status = Status::failed(std::move(reason));
  else
    throw InputError(fmt::format("'{}' is not a status", word));
  entry.seconds = read_number(row.cells[cell + 4], 0.0);
}

}  // namespace tunica::execution
