// SPDX-License-Identifier: Apache-2.0
#include "assembly/channels.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "data/curves.hpp"
#include "tunica/error.hpp"

namespace tunica::assembly {
namespace {

std::string unit_of(const std::string& name, const std::vector<Observable>& observables) {
  const auto found = std::find_if(observables.begin(), observables.end(),
                                  [&name](const Observable& candidate) { return candidate.name == name; });
  return found == observables.end() ? std::string() : found->unit;
}

/// The abscissa of rows if the data prescribe nothing: time, or else the row number.
DrawnOver without_abscissae(const data::Dataset& dataset) {
  if (!dataset.time.empty()) return {"time", "s", dataset.time, {}};
  DrawnOver drawn{"row", "1", {}, {}};
  for (std::size_t row = 0; row < dataset.count; ++row) drawn.values.push_back(static_cast<double>(row));
  return drawn;
}

/// The abscissa of a channel among those of its test; time if all of them are held, or if there is none.
DrawnOver drawn_over(const std::string& channel, const data::Dataset& dataset,
                     const std::vector<Observable>& observables) {
  if (dataset.abscissae.empty()) return without_abscissae(dataset);
  std::vector<data::Prescribed> prescribed;
  for (const auto& [name, values] : dataset.abscissae) prescribed.push_back({name, unit_of(name, observables), values});
  if (data::is_over_time(prescribed, dataset.time)) return {"time", "s", dataset.time, {}};
  std::string own;
  for (const Observable& observable : observables)
    if (observable.name == channel) own = observable.over;
  data::Abscissa chosen = data::abscissa_of(prescribed, own);
  data::Prescribed& over = prescribed[chosen.column];
  return {std::move(over.name), std::move(over.unit), std::move(over.values), std::move(chosen.curves)};
}

}  // namespace

std::vector<bool> fitted_rows(const experiment::TestEntry& entry, const data::Dataset& dataset) {
  const std::size_t count = dataset.count;
  std::vector<bool> fitted(count, !entry.hold_out.all);
  if (entry.hold_out.all || !entry.hold_out.rows) return fitted;
  const data::RowRange& range = *entry.hold_out.rows;
  const auto [first, last] = range.among(count);
  if (first >= count) {
    throw InputError(
        fmt::format("test '{}': hold_out starts at row {}, but only rows 0 … {} are used; choose rows among them",
                    entry.name, range.first, static_cast<std::ptrdiff_t>(count) - 1));
  }
  for (std::size_t row = first; row < last; row += std::max<std::size_t>(range.step, 1)) fitted[row] = false;
  if (dataset.file_rows.empty()) return fitted;
  std::vector<bool> sorted;
  for (const std::size_t row : dataset.file_rows) sorted.push_back(fitted[row]);
  return sorted;
}

std::vector<MeasuredChannel> measured_channels(const experiment::TestEntry& entry, const data::Dataset& dataset,
                                               const std::vector<Observable>& observables, std::size_t offset) {
  std::vector<MeasuredChannel> found;
  if (!entry.weights.empty() && entry.weights.size() != dataset.channels.size()) {
    throw InputError(
        fmt::format("test '{}': {} weights for {} fitted channels; give one number, or one for each channel",
                    entry.name, entry.weights.size(), dataset.channels.size()));
  }
  for (std::size_t k = 0; k < dataset.channels.size(); ++k) {
    const data::Channel& channel = dataset.channels[k];
    MeasuredChannel measured;
    measured.test = entry.name;
    measured.observable = channel.observable;
    measured.unit = channel.unit;
    measured.offset = offset + k * dataset.count;
    measured.count = dataset.count;
    measured.measured = channel.values;
    measured.noise = channel.noise;
    if (measured.noise && channel.replicates.size() > 1) {
      const double root = std::sqrt(static_cast<double>(channel.replicates.size()));
      measured.noise->absolute /= root;
      measured.noise->relative /= root;
    }
    measured.fitted = fitted_rows(entry, dataset);
    for (std::size_t row = 0; row < dataset.count; ++row)
      if (std::isnan(channel.values[row])) measured.fitted[row] = false;  // nothing was measured there
    measured.file_rows = dataset.file_rows;
    if (!entry.weights.empty()) measured.weight = entry.weights[k];
    if (!dataset.abscissae.empty()) {
      const auto& [name, values] = dataset.abscissae.front();
      measured.abscissa_name = name;
      measured.abscissa = values;
      measured.abscissa_unit = unit_of(name, observables);
      for (std::size_t other = 1; other < dataset.abscissae.size(); ++other) {
        const auto& [label, column] = dataset.abscissae[other];
        measured.other_abscissae.emplace_back(fmt::format("{} [{}]", label, unit_of(label, observables)), column);
      }
    } else {
      DrawnOver over = without_abscissae(dataset);
      measured.abscissa_name = std::move(over.name);
      measured.abscissa_unit = std::move(over.unit);
      measured.abscissa = std::move(over.values);
    }
    measured.drawn_over = drawn_over(channel.observable, dataset, observables);
    found.push_back(std::move(measured));
  }
  return found;
}

}  // namespace tunica::assembly
