// SPDX-License-Identifier: Apache-2.0
#include "data/dataset.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "data/curves.hpp"
#include "data/cycles.hpp"
#include "data/loading_path.hpp"
#include "data/nearest.hpp"
#include "data/quantities.hpp"
#include "data/record.hpp"
#include "data/series.hpp"
#include "data/stacking.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

Quantity find_quantity(const std::string& name, const std::vector<Observable>& observables) {
  if (auto quantity = quantity_named(name, observables)) return *std::move(quantity);
  std::vector<std::string> known;
  for (const Observable& observable : observables) known.push_back(observable.name);
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
    const Observable& observable = *find_quantity(name, observables).observable;
    if (!mapped.insert(observable.name).second)
      throw InputError(fmt::format("the observable '{}' is mapped twice; leave out one", observable.name));
    channel = channel || observable.role == Observable::Role::channel;
    time = time || observable.role == Observable::Role::time;
  }
  for (const auto& [name, value] : request.constants) mapped.insert(name);
  for (const Observable& observable : observables)
    if (observable.required && !mapped.contains(observable.name))
      throw InputError(fmt::format("no column is mapped to '{}' ({}), which the test needs; add it to \"columns\"",
                                   observable.name, observable.doc));
  if (!channel && request.files.size() > 1)
    throw InputError("replicates need a measured channel, and none is mapped; add one to \"columns\"");
  if (time && request.time_rate) throw InputError("a time column is mapped and \"time_from\" is given: leave out one");
}

}  // namespace

const std::vector<std::string>& stress_measures() {
  static const std::vector<std::string> names = {"cauchy", "first_piola_kirchhoff", "second_piola_kirchhoff"};
  return names;
}

std::vector<const Observable*> predicted_channels(const DataRequest& request,
                                                  const std::vector<Observable>& observables) {
  std::set<std::string> mapped;
  for (const auto& [name, column] : request.columns) mapped.insert(find_quantity(name, observables).observable->name);
  std::vector<const Observable*> stresses, all;
  for (const Observable& observable : observables) {
    if (observable.role != Observable::Role::channel) continue;
    all.push_back(&observable);
    const Observable* const stretch =
        observable.kind == Observable::Kind::stress ? stretch_beside(observable, observables) : nullptr;
    if (stretch != nullptr && mapped.contains(stretch->name)) stresses.push_back(&observable);
  }
  return stresses.empty() ? all : stresses;
}

std::pair<std::size_t, std::size_t> RowRange::among(std::size_t count) const {
  const auto rows = static_cast<std::ptrdiff_t>(count);
  const auto from_start = [rows](std::ptrdiff_t row) {
    return std::max<std::ptrdiff_t>(row < 0 ? rows + row : row, 0);
  };
  return {static_cast<std::size_t>(from_start(first)),
          static_cast<std::size_t>(std::min(last ? from_start(*last) : rows, rows))};
}

TestRows Dataset::rows() const {
  TestRows rows;
  rows.count = count;
  for (const auto& [observable, values] : abscissae)
    rows.abscissae.push_back({observable, values, std::ranges::find(elongations, observable) != elongations.end()});
  for (const Channel& channel : channels) rows.channels.push_back(channel.observable);
  rows.time = time;
  return rows;
}

namespace {

/// "strip.csv: the rows go through 6 cycles …", where nobody says what several cycles are.
std::optional<std::string> cycles_as_one_curve(const Series& series, const DataRequest& request) {
  if (request.cycle || request.order == Order::loading) return std::nullopt;
  std::vector<Prescribed> prescribed;
  std::vector<const Series::Column*> columns;
  for (const Series::Column& column : series.columns)
    if (column.observable->role == Observable::Role::abscissa) {
      prescribed.push_back({column.observable->name, "", column.values});
      columns.push_back(&column);
    }
  if (prescribed.empty()) return std::nullopt;
  const Series::Column& path = *columns[abscissa_of(prescribed, "").column];
  const auto branches = branches_of(path.values, path.observable->kind == Observable::Kind::stretch ? 1 : 0);
  if (returns_in(path.values, branches) < 2) return std::nullopt;
  return fmt::format(
      "{}: the rows go through {} cycles of '{}' and are read as one curve. Choose some with \"cycle\" (\"last\", a "
      "number or a list), or say with \"cycle\": \"all\" that they are the history of loading.",
      series.header_place(path), cycles_in(branches), path.observable->name);
}

}  // namespace

static Dataset given_dataset(const DataRequest& request) {
  Dataset dataset = *request.given;
  for (Channel& channel : dataset.channels)
    for (const auto& [name, noise] : request.noise)
      if (name == channel.observable) channel.noise = noise;
  if (request.sorted) sort_rows(dataset);
  return dataset;
}

static Dataset read_table(const DataRequest& request, const std::vector<Observable>& observables);

Dataset read_dataset(const DataRequest& request, const std::vector<Observable>& observables) {
  if (request.given) return given_dataset(request);
  if (request.tables.empty()) return read_table(request, observables);
  std::vector<Dataset> tables;
  for (const DataRequest& table : request.tables) tables.push_back(read_table(table, observables));
  Dataset dataset = stacked(tables);
  const auto names = [](const auto& list, const std::string& name) {
    return std::ranges::any_of(list, [&](const auto& one) { return one.first == name; });
  };
  std::erase_if(dataset.channels, [&](const Channel& channel) {
    return std::ranges::none_of(request.columns, [&](const auto& column) {
      return quantity_named(column.first, observables)->observable->name == channel.observable;
    });
  });
  for (Channel& channel : dataset.channels) {
    const bool was_stated = std::ranges::any_of(
        request.tables, [&](const DataRequest& table) { return names(table.noise, channel.observable); });
    if (was_stated && !names(request.noise, channel.observable)) channel.noise.reset();
    for (const auto& [name, noise] : request.noise)
      if (name == channel.observable) channel.noise = noise;
  }
  if (request.sorted) sort_rows(dataset);
  return dataset;
}

static Dataset read_table(const DataRequest& request, const std::vector<Observable>& observables) {
  check_request(request, observables);
  Dataset dataset;
  std::vector<Series> replicates;
  for (const std::filesystem::path& file : request.files) {
    replicates.push_back(read_series(file, request, observables, dataset.warnings));
    check_series(replicates.back(), dataset.warnings);
    if (!request.part) look_at_record(replicates.back(), request, dataset.findings);
    if (auto warning = request.part ? std::nullopt : cycles_as_one_curve(replicates.back(), request))
      dataset.warnings.insert(dataset.warnings.begin(), *std::move(warning));
    dataset.sha256.push_back(replicates.back().sha256);
  }
  align(replicates, dataset.warnings);
  const Series& first = replicates.front();
  dataset.count = first.lines.size();
  dataset.lines = first.lines;
  dataset.time = first.time;
  dataset.understood = understood(first, request, observables);
  for (const auto& [name, value] : request.constants) {
    dataset.abscissae.emplace_back(name, std::vector<double>(dataset.count, value));
    dataset.source_columns.push_back({name, {name, ""}});
  }
  for (std::size_t k = 0; k < first.columns.size(); ++k) {
    const Series::Column& column = first.columns[k];
    const Observable& observable = *column.observable;
    dataset.source_columns.push_back(
        {observable.name, {column.derived ? observable.name : column.name, column.derived ? "" : column.unit}});
    if (observable.role == Observable::Role::abscissa) dataset.abscissae.emplace_back(observable.name, column.values);
    if (column.elongation) dataset.elongations.push_back(observable.name);
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
    for (const auto& [name, noise] : first.scatter)
      if (name == observable.name) channel.noise = noise;
    for (const auto& [name, noise] : request.noise)
      if (name == observable.name) channel.noise = noise;
    dataset.channels.push_back(std::move(channel));
  }
  if (dataset.channels.empty() && !request.part)
    for (const Observable* const predicted : predicted_channels(request, observables)) {
      const std::vector<double> nothing(dataset.count, std::numeric_limits<double>::quiet_NaN());
      dataset.channels.push_back({predicted->name, predicted->unit, nothing, {}, {}});
      dataset.source_columns.push_back({predicted->name, {predicted->name, ""}});
    }
  const bool timed = !dataset.time.empty() && dataset.time.back() > dataset.time.front();
  dataset.ordered = request.order == Order::loading || request.cycle || timed || dataset.count < 2;
  if (request.sorted) sort_rows(dataset);
  return dataset;
}

}  // namespace tunica::data
