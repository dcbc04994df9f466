// SPDX-License-Identifier: Apache-2.0
#include "data/signal.hpp"

#include <limits>
#include <set>

#include <fmt/format.h>

#include "data/csv.hpp"
#include "data/quantities.hpp"
#include "data/series.hpp"
#include "data/table_place.hpp"

namespace tunica::data {
namespace {

Signal::Column column_of(const Csv& csv, std::size_t index) {
  const Csv::Column& header = csv.columns[index];
  const std::string unit = header.unit.value_or("");
  Signal::Column column{unit.empty() ? header.name : fmt::format("{} [{}]", header.name, unit), {}};
  const char decimal = csv.decimal_mark({index});
  for (const Csv::Row& row : csv.rows)
    column.values.push_back(looks_like_number(row.cells[index], decimal == ',')
                                ? csv.number(row, index, decimal)
                                : std::numeric_limits<double>::quiet_NaN());
  return column;
}

}  // namespace

std::vector<Signal> read_signals(const DataRequest& request, const std::vector<Observable>& observables) {
  std::vector<Signal> signals;
  for (const DataRequest& table : request.tables)
    for (Signal& signal : read_signals(table, observables)) signals.push_back(std::move(signal));
  if (!request.tables.empty()) return signals;
  for (const std::filesystem::path& file : request.files) {
    std::vector<std::string> warnings;
    const Series series = read_series(file, request, observables, warnings);
    const std::set<std::size_t> used(series.used_lines.begin(), series.used_lines.end());
    const auto table = table_file(file, request.layout);
    const Csv& csv = table->csv;
    Signal signal{file, {"line of the file", {}}, {}, {}};
    for (const Csv::Row& row : csv.rows) {
      signal.clock.values.push_back(static_cast<double>(row.line));
      signal.used.push_back(used.contains(row.line));
    }
    for (const auto& [name, column] : request.columns) {
      const bool time = quantity_named(name, observables)->observable->role == Observable::Role::time;
      (time ? signal.clock : signal.columns.emplace_back()) = column_of(csv, csv.column(column));
    }
    signals.push_back(std::move(signal));
  }
  return signals;
}

}  // namespace tunica::data
