// SPDX-License-Identifier: Apache-2.0
#include "comparison/bound_warnings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "comparison/ranking.hpp"
#include "text/lists.hpp"
#include "text/units.hpp"

namespace tunica::comparison {

namespace {

using BoundKind = assembly::FreeParameter::Bound;

/// What to do about a parameter at its bound.
std::string remedy_at(BoundKind kind, const std::string& name, bool upper) {
  switch (kind) {
    case BoundKind::symmetry:
      return "It is a point of symmetry, beyond which the same material comes again: there is nothing to widen";
    case BoundKind::physical:
      return "It is a physical end: the data want nothing of what it stands for, or the model lacks something. There "
             "is nothing to widen";
    case BoundKind::by_default:
      return fmt::format(
          "The bound is the default, nobody chose it. The best value may lie beyond it: widen it with "
          "\"{}\" of '{}' if physics allows it, otherwise doubt the model",
          upper ? "max" : "min", name);
    case BoundKind::chosen:
      break;
  }
  return "The best value may lie beyond it. Widen the bound if physics allows it, otherwise doubt the model";
}

/// Objectives of other searches up to this one are worth a look. Where the winner describes the data to within their
/// noise, nothing is better, and only a place as good is. Sums of squares over the noise differ by about one of noise
/// alone; other objectives have a unit, and no such floor.
double promising_objective(const RunSummary& run) {
  const bool to_noise = run.misfit && run.misfit->judged() && !run.misfit->contradicts();
  const double floor = run.objective_type == name_of(experiment::ObjectiveType::least_squares) ? 1.0 : 0.0;
  return (to_noise ? 1.1 : 100) * std::max(std::abs(run.objective), floor);
}

}  // namespace

void warn_of_bounds(const RunSummary& run, std::vector<execution::Warning>& warnings) {
  for (const auto& parameter : run.parameters) {
    if (parameter.at_bound == Estimate::Bound::none) continue;
    const bool upper = parameter.at_bound == Estimate::Bound::upper;
    const std::string unit = text::unit_suffix(parameter.unit);
    warnings.push_back(
        {execution::WarningKind::at_bound,
         fmt::format("{} = {:.6g}{} lies at its {} bound ({:.6g}{}). {}", parameter.name, parameter.value, unit,
                     upper ? "upper" : "lower", upper ? parameter.max : parameter.min, unit,
                     remedy_at(upper ? parameter.upper_kind : parameter.lower_kind, parameter.name, upper)),
         run.label,
         {parameter.name}});
  }
}

void warn_of_default_bounds(const RunSummary& run, std::vector<execution::Warning>& warnings) {
  struct Stopped {
    const Estimate& parameter;
    const Estimate::Stops& stops;
    bool upper;
    [[nodiscard]] const char* side() const { return upper ? "upper" : "lower"; }
    [[nodiscard]] std::string bound() const {
      return fmt::format("{:.6g}{}", upper ? parameter.max : parameter.min, text::unit_suffix(parameter.unit));
    }
  };
  std::vector<Stopped> all;
  std::vector<std::string> subjects, keys;
  for (const auto& parameter : run.parameters)
    for (const bool upper : {false, true}) {
      const Estimate::Stops& stops = upper ? parameter.stops_upper : parameter.stops_lower;
      const bool winner = parameter.at_bound == (upper ? Estimate::Bound::upper : Estimate::Bound::lower);
      if (stops.count == 0 || winner || stops.objective > promising_objective(run)) continue;
      if ((upper ? parameter.upper_kind : parameter.lower_kind) != BoundKind::by_default) continue;
      all.push_back({parameter, stops, upper});
      keys.push_back(fmt::format("\"{}\" of '{}'", upper ? "max" : "min", parameter.name));
      if (subjects.empty() || subjects.back() != parameter.name) subjects.push_back(parameter.name);
    }
  if (all.empty()) return;
  std::string others;
  for (auto one = all.begin() + 1; one != all.end(); ++one)
    others += fmt::format("; {} at the {} one of {} ({}), the best at {:.5g}", one->stops.count, one->side(),
                          one->parameter.name, one->bound(), one->stops.objective);
  const Stopped& first = all.front();
  warnings.push_back(
      {execution::WarningKind::stopped_at_default_bound,
       fmt::format("{} of {} searches stopped at the default {} bound of {} ({}), the best of them at the objective "
                   "{:.5g}{}; the run ends at {:.5g} elsewhere. A better point may lie beyond a bound that nobody "
                   "chose: widen it with {}",
                   first.stops.count, run.searches, first.side(), first.parameter.name, first.bound(),
                   first.stops.objective, others, run.objective, text::joined(keys)),
       run.label, subjects});
}

}  // namespace tunica::comparison
