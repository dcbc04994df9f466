// SPDX-License-Identifier: Apache-2.0
#include "data/dataset.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "data/csv.hpp"
#include "data/loading_path.hpp"
#include "data/nearest.hpp"
#include "data/series.hpp"
#include "data/sha256.hpp"
#include "data/units.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

const Observable& find_observable(const std::string& name, const std::vector<Observable>& observables) {
  std::vector<std::string> known;
  for (const Observable& observable : observables) {
    if (observable.name == name) return observable;
    known.push_back(observable.name);
  }
  throw InputError(fmt::format("the test has no observable '{}'. {}", excerpt(name), suggestion(name, known)));
}

// The experiment file is checked with its own line numbers; these checks serve callers without one.
void check_request(const DataRequest& request, const std::vector<Observable>& observables) {
  if (request.files.empty()) throw InputError("no data file is named. Give \"file\" or \"files\".");
  const auto& measures = stress_measures();
  if (std::find(measures.begin(), measures.end(), request.stress_measure) == measures.end())
    throw InputError(fmt::format("unknown stress measure '{}'. {}", excerpt(request.stress_measure),
                                 suggestion(request.stress_measure, measures)));
  std::set<std::string> mapped;
  bool channel = false, time = false;
  for (const auto& [name, column] : request.columns) {
    const Observable& observable = find_observable(name, observables);
    if (!mapped.insert(name).second)
      throw InputError(fmt::format("the observable '{}' is mapped twice; leave out one", name));
    channel = channel || observable.role == Observable::Role::channel;
    time = time || observable.role == Observable::Role::time;
  }
  for (const Observable& observable : observables)
    if (observable.required && !mapped.contains(observable.name))
      throw InputError(fmt::format("no column is mapped to '{}' ({}), which the test needs; add it to \"columns\"",
                                   observable.name, observable.doc));
  if (!channel) throw InputError("no measured channel is mapped, so there is nothing to fit; add one to \"columns\"");
  if (time && request.time_rate) throw InputError("a time column is mapped and \"time_from\" is given: leave out one");
}

// 12 and 12.0 are the same specimen number; everything else is compared as text.
bool same_value(const std::string& cell, const std::string& wanted) {
  if (cell == wanted) return true;
  const auto number = [](const std::string& text, double& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
  };
  double a = 0, b = 0;
  return number(cell, a) && number(wanted, b) && a == b;
}

std::vector<const Csv::Row*> rows_where(const Csv& csv, const DataRequest& request) {
  std::vector<const Csv::Row*> rows;
  for (const Csv::Row& row : csv.rows) rows.push_back(&row);
  for (const auto& condition : request.where) {
    const std::size_t column = csv.column(condition.first);
    const std::string& value = condition.second;
    std::vector<std::string> present;
    for (const Csv::Row* row : rows)
      if (present.size() < 20 && std::find(present.begin(), present.end(), row->cells[column]) == present.end())
        present.push_back(excerpt(row->cells[column]));
    std::erase_if(rows, [&](const Csv::Row* row) { return !same_value(row->cells[column], value); });
    if (rows.empty())
      throw InputError(fmt::format("{}: no row left has the value '{}' that \"where\" asks for. {}",
                                   csv.place(csv.header_line, column), excerpt(value), suggestion(value, present)));
  }
  return rows;
}

std::vector<std::size_t> selection(const Csv& csv, const RowRange& range, std::size_t count,
                                   std::vector<std::string>& warnings) {
  const std::size_t last = std::min(range.last.value_or(count), count);
  std::vector<std::size_t> selected;
  for (std::size_t row = range.first; row < last; row += std::max<std::size_t>(range.step, 1)) {
    selected.push_back(row);
    if (range.step > count) break;  // also keeps the sum from overflowing
  }
  if (selected.empty())
    throw InputError(fmt::format(
        "{}, line {}: \"rows\" begins at {} and ends before {}, but there are rows 0 to {}{}. Correct \"rows\".",
        csv.file.string(), csv.header_line, range.first, range.last ? fmt::format("{}", *range.last) : "the end",
        count - 1, count < csv.rows.size() ? " after \"where\"" : ""));
  if (range.last && *range.last > count)
    warnings.push_back(fmt::format("{}: \"rows\" ends at {}, but there are only {} rows; all up to the end are used.",
                                   csv.file.string(), *range.last, count));
  return selected;
}

// The factor is asked for once a cell: units like degrees Celsius have an offset.
double in_base_unit(const Series& series, const Series::Column& column, double value) {
  try {
    return convert(value, column.unit.empty() ? column.observable->unit : column.unit, column.observable->unit);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}. The observable '{}' is in {}: correct the unit in the header.",
                                 series.header_place(column), error.what(), column.observable->name,
                                 column.observable->unit));
  }
}

/// Time on a path run at constant rate: t_i = t_{i−1} + |x_i − x_{i−1}|/rate, from rest (stretch 1, else 0) at t = 0.
/// The path is that of all rows left after `where`, so that thinning them out with `rows` does not shorten cycles.
std::vector<double> time_along(const std::vector<double>& path, double rest, double rate) {
  std::vector<double> time;
  double now = 0, last = rest;
  for (const double x : path) {
    now += std::abs(x - last) / rate;
    time.push_back(now);
    last = x;
  }
  return time;
}

}  // namespace

const std::vector<std::string>& stress_measures() {
  static const std::vector<std::string> names = {"cauchy", "first_piola_kirchhoff", "second_piola_kirchhoff"};
  return names;
}

std::string Series::place(std::size_t row, const Column& column) const {
  return fmt::format("{}, line {}, column {} ('{}')", file.string(), lines[row], column.index + 1,
                     excerpt(column.name));
}

std::string Series::header_place(const Column& column) const {
  return fmt::format("{}, line {}, column {} ('{}')", file.string(), header_line, column.index + 1,
                     excerpt(column.name));
}

Series read_series(const std::filesystem::path& file, const DataRequest& request,
                   const std::vector<Observable>& observables, std::vector<std::string>& warnings) {
  const std::string bytes = read_bytes(file);
  const Csv csv = parse_csv(file, bytes);
  Series series{file, sha256(bytes), csv.header_line, {}, {}, {}};
  std::vector<std::size_t> indices;
  for (const auto& [name, column] : request.columns) {
    indices.push_back(csv.column(column));
    const Csv::Column& header = csv.columns[indices.back()];
    const Observable& observable = find_observable(name, observables);
    series.columns.push_back({&observable, indices.back(), header.name, header.unit.value_or(""), {}});
    in_base_unit(series, series.columns.back(), 1);  // a wrong unit is reported before the first wrong cell
    if (series.columns.back().unit.empty() && observable.unit != "1")
      warnings.push_back(fmt::format("{}: the header gives no unit; {} is assumed. Write '{} [{}]'.",
                                     series.header_place(series.columns.back()), observable.unit, header.name,
                                     observable.unit));
  }
  const char decimal = csv.decimal_mark(indices);
  const std::vector<const Csv::Row*> rows = rows_where(csv, request);
  const std::vector<std::size_t> selected = selection(csv, request.rows, rows.size(), warnings);
  for (const std::size_t row : selected) series.lines.push_back(rows[row]->line);
  for (Series::Column& column : series.columns)
    for (const std::size_t row : selected)
      column.values.push_back(in_base_unit(series, column, csv.number(*rows[row], column.index, decimal)));
  const auto path = std::find_if(series.columns.begin(), series.columns.end(), [](const Series::Column& column) {
    return column.observable->role == Observable::Role::abscissa;
  });
  if (request.time_rate && path != series.columns.end()) {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const Csv::Row* row : rows)
      values.push_back(in_base_unit(series, *path, csv.number(*row, path->index, decimal)));
    const double rest = path->observable->kind == Observable::Kind::stretch ? 1 : 0;
    const std::vector<double> time = time_along(values, rest, *request.time_rate);
    for (const std::size_t row : selected) series.time.push_back(time[row]);
  }
  return series;
}

TestRows Dataset::rows() const {
  TestRows rows;
  rows.count = count;
  for (const auto& [observable, values] : abscissae) rows.abscissae.push_back({observable, values});
  for (const Channel& channel : channels) rows.channels.push_back(channel.observable);
  rows.time = time;
  return rows;
}

Dataset read_dataset(const DataRequest& request, const std::vector<Observable>& observables) {
  check_request(request, observables);
  Dataset dataset;
  std::vector<Series> replicates;
  for (const std::filesystem::path& file : request.files) {
    replicates.push_back(read_series(file, request, observables, dataset.warnings));
    check_series(replicates.back(), dataset.warnings);
    dataset.sha256.push_back(replicates.back().sha256);
  }
  align(replicates, dataset.warnings);
  const Series& first = replicates.front();
  dataset.count = first.lines.size();
  dataset.lines = first.lines;
  dataset.time = first.time;
  for (std::size_t k = 0; k < first.columns.size(); ++k) {
    const Series::Column& column = first.columns[k];
    const Observable& observable = *column.observable;
    dataset.source_columns.push_back({observable.name, {column.name, column.unit}});
    if (observable.role == Observable::Role::abscissa) dataset.abscissae.emplace_back(observable.name, column.values);
    if (observable.role == Observable::Role::time) dataset.time = column.values;
    if (observable.role != Observable::Role::channel) continue;
    Channel channel{observable.name, observable.unit, column.values, {}, {}};
    if (replicates.size() > 1) {
      for (const Series& series : replicates) channel.replicates.push_back(series.columns[k].values);
      for (std::size_t row = 0; row < dataset.count; ++row) {
        double sum = 0;
        for (const auto& values : channel.replicates) sum += values[row];
        channel.values[row] = sum / static_cast<double>(replicates.size());
      }
    }
    for (const auto& [name, noise] : request.noise)
      if (name == observable.name) channel.noise = noise;
    dataset.channels.push_back(std::move(channel));
  }
  const bool timed = !dataset.time.empty() && dataset.time.back() > dataset.time.front();
  dataset.ordered = request.order == Order::loading || timed || dataset.count < 2;
  if (request.sorted) sort_rows(dataset);
  return dataset;
}

}  // namespace tunica::data
