// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "data/series.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

using Role = Observable::Role;

bool is_abscissa(const Series::Column& column) { return column.observable->role == Role::abscissa; }

bool same_abscissae(const Series& a, const Series& b) {
  if (a.lines.size() != b.lines.size()) return false;
  for (std::size_t k = 0; k < a.columns.size(); ++k) {
    if (!is_abscissa(a.columns[k])) continue;
    for (std::size_t row = 0; row < a.lines.size(); ++row) {
      const double x = a.columns[k].values[row], y = b.columns[k].values[row];
      if (std::abs(x - y) > 1e-9 * std::max({std::abs(x), std::abs(y), 1e-6})) return false;
    }
  }
  return true;
}

// The one abscissa to interpolate along: it must rise all the way.
const Series::Column& path_of(const Series& series) {
  const Series::Column* path = nullptr;
  for (const Series::Column& column : series.columns) {
    if (!is_abscissa(column)) continue;
    if (path != nullptr)
      throw InputError(
          fmt::format("{}: replicates with several abscissae must have the same rows, and these differ from "
                      "those of the first file. Give each file a test of its own.",
                      series.file.string()));
    path = &column;
  }
  if (path == nullptr)
    throw InputError(
        fmt::format("{}: the replicate has {} rows, a different number from the first file, and no abscissa "
                    "to compare them along. Give each file a test of its own.",
                    series.file.string(), series.lines.size()));
  for (std::size_t row = 1; row < path->values.size(); ++row)
    if (!(path->values[row] > path->values[row - 1]))
      throw InputError(
          fmt::format("{}: replicates with other abscissae are interpolated, which needs an abscissa that "
                      "rises from row to row; here it does not. Select the loading branch with \"rows\", or "
                      "give each file a test of its own.",
                      series.place(row, *path)));
  return *path;
}

double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = std::lower_bound(x.begin(), x.end(), at);
  const auto i = static_cast<std::size_t>(above - x.begin());
  if (i == 0) return y.front();
  if (i == x.size()) return y.back();
  const double t = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return (1 - t) * y[i - 1] + t * y[i];
}

void keep_rows(Series& series, const std::vector<std::size_t>& rows) {
  const auto pick = [&rows](auto& values) {
    auto kept = values;
    kept.clear();
    for (const std::size_t row : rows) kept.push_back(values[row]);
    values = std::move(kept);
  };
  for (Series::Column& column : series.columns) pick(column.values);
  if (!series.time.empty()) pick(series.time);
  pick(series.lines);
}

}  // namespace

void align(std::vector<Series>& replicates, std::vector<std::string>& warnings) {
  Series& first = replicates.front();
  std::vector<Series*> others;
  for (auto other = replicates.begin() + 1; other != replicates.end(); ++other)
    if (!same_abscissae(first, *other)) others.push_back(&*other);
  if (others.empty()) return;
  double low = path_of(first).values.front(), high = path_of(first).values.back();
  for (const Series* other : others) {
    low = std::max(low, path_of(*other).values.front());
    high = std::min(high, path_of(*other).values.back());
  }
  std::vector<std::size_t> common;
  const std::vector<double> path = path_of(first).values;
  for (std::size_t row = 0; row < path.size(); ++row)
    if (path[row] >= low && path[row] <= high) common.push_back(row);
  if (common.empty())
    throw InputError(
        fmt::format("{}: no row of this file lies where all replicates have measured ('{}' from {} to {}). Give each "
                    "file a test of its own.",
                    first.file.string(), path_of(first).name, low, high));
  if (common.size() < path.size())
    warnings.push_back(
        fmt::format("{}: {} of {} rows are left out because some replicate does not reach them ('{}' from "
                    "{} to {} is common to all).",
                    first.file.string(), path.size() - common.size(), path.size(), path_of(first).name, low, high));
  for (Series* other : others) {
    const std::vector<double> x = path_of(*other).values;
    for (Series::Column& column : other->columns) {
      std::vector<double> at_first;
      at_first.reserve(path.size());
      for (const double value : path) at_first.push_back(interpolated(x, column.values, value));
      column.values = std::move(at_first);
    }
    other->lines = first.lines;
    if (!other->time.empty()) other->time = first.time;
    warnings.push_back(
        fmt::format("{}: the abscissae differ from those of {}; its rows are interpolated linearly there.",
                    other->file.string(), first.file.filename().string()));
  }
  for (Series& series : replicates) keep_rows(series, common);
}

}  // namespace tunica::data
