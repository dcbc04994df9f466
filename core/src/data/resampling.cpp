// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "data/curves.hpp"
#include "data/cycles.hpp"
#include "data/local_regression.hpp"
#include "data/series.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

/// The prescribed column that goes through its range most straightly.
std::size_t swept_column(const Series& series) {
  std::vector<Prescribed> prescribed;
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; k < series.columns.size(); ++k)
    if (series.columns[k].observable->role == Observable::Role::abscissa) {
      prescribed.push_back({series.columns[k].name, "", series.columns[k].values});
      columns.push_back(k);
    }
  if (prescribed.empty())
    throw InputError(
        fmt::format("{}: \"resample\" needs a prescribed quantity, and none is mapped. Map one in "
                    "\"columns\".",
                    series.file.string()));
  return columns[abscissa_of(prescribed, "").column];
}

std::vector<double> evenly(double from, double to, std::size_t points) {
  std::vector<double> at;
  for (std::size_t k = 0; k < points; ++k)
    at.push_back(from + (to - from) * static_cast<double>(k) / static_cast<double>(points - 1));
  return at;
}

std::size_t nearest_row(const std::vector<double>& path, const Branch& branch, double x) {
  std::size_t nearest = branch.first;
  for (std::size_t row = branch.first; row < branch.last; ++row)
    if (std::abs(path[row] - x) < std::abs(path[nearest] - x)) nearest = row;
  return nearest;
}

}  // namespace

void resample(Series& series, std::size_t points) {
  const std::size_t path_column = swept_column(series);
  const std::vector<double> path = series.columns[path_column].values;
  const bool stretch = series.columns[path_column].observable->kind == Observable::Kind::stretch;
  Series found = series;
  found.lines.clear();
  found.time.clear();
  for (Series::Column& column : found.columns) column.values.clear();
  struct Error {
    double squares = 0, correlation = 0;
  };
  std::vector<Error> errors(series.columns.size());
  double branches = 0;
  for (const Branch& branch : branches_of(path, stretch ? 1 : 0)) {
    const std::size_t rows = branch.last - branch.first;
    if (rows < points)
      throw InputError(fmt::format("{}: \"resample\" is {}, and a branch has only {} rows. Give fewer points.",
                                   series.place(branch.first, series.columns[path_column]), points, rows));
    const std::span<const double> x = std::span(path).subspan(branch.first, rows);
    const std::vector<double> at = evenly(x.front(), x.back(), points);
    const double reach = std::abs(x.back() - x.front()) / static_cast<double>(points - 1);
    for (const double t : at) found.lines.push_back(series.lines[nearest_row(path, branch, t)]);
    const auto smooth = [&](const std::vector<double>& values) {
      return local_regression(x, std::span(values).subspan(branch.first, rows), at, reach);
    };
    for (std::size_t k = 0; k < series.columns.size(); ++k) {
      const Smoothed smoothed = smooth(series.columns[k].values);
      const std::vector<double>& values = k == path_column ? at : smoothed.values;
      found.columns[k].values.insert(found.columns[k].values.end(), values.begin(), values.end());
      errors[k].squares += smoothed.error * smoothed.error;
      errors[k].correlation += smoothed.correlation;
    }
    if (!series.time.empty()) {
      const Smoothed time = smooth(series.time);
      found.time.insert(found.time.end(), time.values.begin(), time.values.end());
    }
    ++branches;
  }
  for (std::size_t k = 0; k < series.columns.size(); ++k)
    if (series.columns[k].observable->role == Observable::Role::channel && errors[k].squares > 0)
      found.scatter.emplace_back(series.columns[k].observable->name,
                                 Noise{std::sqrt(errors[k].squares / branches), 0, errors[k].correlation / branches});
  series = std::move(found);
}

}  // namespace tunica::data
