// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/hypotheses/places.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::diagnosis {
namespace {

using experiment::Experiment;
using experiment::RunEntry;

constexpr std::size_t clock_points = 6;

}  // namespace

bool takes(const MechanismFactory& mechanism, const std::string& option) {
  return std::any_of(mechanism.options.begin(), mechanism.options.end(),
                     [&](const Option& declared) { return declared.name == option; });
}

CauseGroup group_of(const MechanismFactory& mechanism) {
  using Origin = MechanismFactory::Origin;
  if (mechanism.origin == Origin::by_stage)
    return mechanism.stage < Stage::test ? CauseGroup::material : CauseGroup::rig;
  return mechanism.origin == Origin::material ? CauseGroup::material : CauseGroup::rig;
}

bool unloads(const assembly::Assembly& base, const std::string& test) {
  constexpr double part = 0.1;
  for (const assembly::MeasuredChannel& view : base.layout().channels) {
    if (view.test != test || view.abscissa.empty()) continue;
    const auto [low, high] = std::minmax_element(view.abscissa.begin(), view.abscissa.end());
    double largest = -INFINITY;
    for (const double value : view.abscissa) {
      largest = std::max(largest, value);
      if (value < largest - part * (*high - *low)) return true;
    }
  }
  return false;
}

std::vector<double> Clock::paces() const {
  constexpr double fast = 1e-6;  // of the shortest step
  if (!missing || !(longest > 0) || !std::isfinite(shortest)) return {};
  return {fast * shortest, pace};
}

Clock clock_of(const Experiment& experiment, const RunEntry& run, const plugins::Catalogue& catalogue) {
  Clock clock;
  std::size_t steps = 0;
  double seconds = 0;
  for (const std::string& name : run.tests) {
    const auto& entry = experiment.test(name);
    const auto dataset = data::read_dataset(entry.data, catalogue.tests().find(entry.type)->second.factory.observables);
    clock.missing = clock.missing || (pace_is_open(entry, dataset) && !entry.hold_out.all);
    if (dataset.time.size() < 2) continue;
    const double duration = dataset.time.back() - dataset.time.front();
    clock.longest = std::max(clock.longest, duration);
    seconds += duration;
    steps += dataset.time.size() - 1;
    for (std::size_t i = 1; i < dataset.time.size(); ++i)
      if (const double step = dataset.time[i] - dataset.time[i - 1]; step > 0)
        clock.shortest = std::min(clock.shortest, step);
  }
  if (steps > 0) clock.pace = seconds / static_cast<double>(steps);
  return clock;
}

bool pace_is_open(const experiment::TestEntry& entry, const data::Dataset& dataset) {
  return entry.data.sorted && dataset.time.empty();
}

bool needs_clock(const MechanismFactory& mechanism) {
  return std::any_of(mechanism.parameters.begin(), mechanism.parameters.end(),
                     [](const Parameter& parameter) { return parameter.unit == "s"; });
}

std::vector<MechanismFactory::Setting> settings_to_try(const MechanismFactory& mechanism, const Clock& clock) {
  if (!mechanism.scan.empty()) return mechanism.scan;
  std::vector<MechanismFactory::Setting> found;
  for (std::size_t k = 1; k < mechanism.parameters.size(); ++k) {
    const Parameter& nuisance = mechanism.parameters[k];
    if (nuisance.unit != "s" || !(clock.longest > 0)) continue;
    const double low = std::clamp(clock.shortest, nuisance.min, nuisance.max);
    const double high = std::clamp(clock.longest, nuisance.min, nuisance.max);
    for (std::size_t i = 0; i < clock_points; ++i)
      found.push_back({{nuisance.name, low * std::pow(high / low, static_cast<double>(i) / (clock_points - 1))}});
    break;
  }
  if (found.empty()) found.emplace_back();
  return found;
}

std::vector<Place> single_places(const MechanismFactory& mechanism, const Experiment& experiment, const RunEntry& run,
                                 const assembly::Assembly& base) {
  std::vector<Place> places;
  for (const std::string& name : run.tests) {
    const auto& entry = experiment.test(name);
    if (entry.hold_out.all) continue;
    const auto& types = mechanism.applies_to;
    if (!types.empty() && std::find(types.begin(), types.end(), entry.type) == types.end()) continue;
    if (!takes(mechanism, "channel")) {
      places.push_back({{name}});
      continue;
    }
    for (const assembly::MeasuredChannel& view : base.layout().channels)
      if (view.test == name && std::find(view.fitted.begin(), view.fitted.end(), true) != view.fitted.end())
        places.push_back({{name}, view.observable});
  }
  return places;
}

void add_rows(const Hypothesis& whole, const assembly::Assembly& base, std::vector<Hypothesis>& into) {
  // Neighbours in a field are not those in the file, and a point of a thousand is no cause of what the others show.
  const auto is_taken = [&whole](const assembly::MeasuredChannel& view, std::size_t row) {
    return view.test == whole.addition.place.tests.front() && view.observable == whole.addition.place.channel &&
           view.fitted[row] && !view.is_point(row);
  };
  const auto& channels = base.layout().channels;
  if (std::ranges::none_of(channels, [&](const assembly::MeasuredChannel& view) {
        for (std::size_t row = 0; row < view.count; ++row)
          if (is_taken(view, row)) return true;
        return false;
      }))
    return;
  const std::size_t rows = base.layout().residual_count, predictions = base.layout().prediction_count;
  std::vector<double> unit(rows, 0.0), map(predictions);
  // Row k of the whitening, read off its transpose.
  std::vector<std::vector<std::pair<std::size_t, double>>> columns(predictions);
  for (std::size_t k = 0; k < rows; ++k) {
    unit[k] = 1;
    base.evaluator().transpose_residuals(unit, map);
    unit[k] = 0;
    for (std::size_t i = 0; i < predictions; ++i)
      if (map[i] != 0) columns[i].emplace_back(k, map[i]);
  }
  for (const assembly::MeasuredChannel& view : channels) {
    for (std::size_t i = 0; i < view.count; ++i) {
      if (!is_taken(view, i)) continue;
      Hypothesis one = whole;
      one.addition.place.row = i;
      one.addition.place.file_row = view.file_row(i);
      one.signature = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows));
      for (const auto& [k, value] : columns[view.offset + i]) one.signature[static_cast<Eigen::Index>(k)] = value;
      into.push_back(std::move(one));
    }
  }
}

}  // namespace tunica::diagnosis
