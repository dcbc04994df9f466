// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/hypotheses/amplitude_range.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::diagnosis {
namespace {

constexpr double beyond_plausible = 5;  ///< bounds, over the largest plausible distance from the null
constexpr double small_step = 1e-4;     ///< of the declared reach, for a difference

double span_of(const assembly::MeasuredChannel& view) {
  const auto [low, high] = std::minmax_element(view.measured.begin(), view.measured.end());
  return view.measured.empty() ? 0 : *high - *low;
}

/// Predictions by the amplitude, at the null.
std::vector<double> effect_of(const Extension& extended, const MechanismFactory& mechanism,
                              const std::vector<double>& null, assembly::Workspace& workspace) {
  const assembly::Layout& layout = extended.assembly().layout();
  const std::size_t n = layout.prediction_count, width = layout.parameters.size();
  const Variable& amplitude = extended.parts().front().amplitude;
  std::vector<double> values(n), effect(n, 0.0);
  if (layout.jacobian_is_exact) {
    std::vector<double> jacobian(n * width);
    if (!extended.assembly().evaluator().predict(null, values, jacobian, workspace).ok()) return {};
    for (std::size_t i = 0; i < n; ++i)
      for (const std::size_t member : amplitude) effect[i] += jacobian[i * width + member];
    return effect;
  }
  const double step = small_step * (mechanism.plausible_max - mechanism.null);
  std::vector<double> there = null;
  for (const std::size_t member : amplitude) there[member] += step;
  if (!extended.assembly().evaluator().predict(null, values, {}, workspace).ok() ||
      !extended.assembly().evaluator().predict(there, effect, {}, workspace).ok())
    return {};
  for (std::size_t i = 0; i < n; ++i) effect[i] = (effect[i] - values[i]) / step;
  return effect;
}

/// The amplitude whose effect fills the range of the channel that it shows most in; 0: it shows nowhere.
double filling_amplitude(const assembly::Layout& layout, const std::vector<double>& effect) {
  double least = INFINITY;
  for (const assembly::MeasuredChannel& view : layout.channels) {
    double largest = 0;
    for (std::size_t i = 0; i < view.count; ++i) largest = std::max(largest, std::abs(effect[view.offset + i]));
    if (largest > 0) least = std::min(least, span_of(view) / largest);
  }
  return std::isfinite(least) ? least : 0;
}

/// Those sides of the null that the mechanism declares, as far out as `reach`.
AmplitudeRange around(const MechanismFactory& mechanism, double reach) {
  const Parameter& declared = mechanism.parameters.front();
  const double null = mechanism.null, bound = beyond_plausible * reach;
  AmplitudeRange range{mechanism.plausible_min < null ? null - reach : null,
                       mechanism.plausible_max > null ? null + reach : null, declared.min < null ? null - bound : null,
                       declared.max > null ? null + bound : null};
  if (declared.unit != "1") return range;
  return {std::min(range.plausible_min, mechanism.plausible_min),
          std::max(range.plausible_max, mechanism.plausible_max), std::min(range.min, declared.min),
          std::max(range.max, declared.max)};
}

}  // namespace

AmplitudeRange range_of(const MechanismFactory& mechanism, const Addition& addition) {
  if (addition.range) return *addition.range;
  const Parameter& declared = mechanism.parameters.front();
  return {mechanism.plausible_min, mechanism.plausible_max, declared.min, declared.max};
}

std::vector<double> with_setting(const Extension& extended, const MechanismFactory& mechanism,
                                 const MechanismFactory::Setting& setting, std::vector<double> null) {
  const Extension::Part& part = extended.parts().front();
  for (std::size_t k = 0; k < part.nuisance.size(); ++k)
    for (const auto& [name, value] : setting)
      if (name == mechanism.parameters[k + 1].name)
        for (const std::size_t member : part.nuisance[k]) {
          const auto& parameter = extended.assembly().layout().parameters[member];
          null[member] = std::clamp(value, parameter.min, parameter.max);
        }
  return null;
}

std::optional<AmplitudeRange> range_from_data(const Extension& extended, const MechanismFactory& mechanism,
                                              const std::vector<MechanismFactory::Setting>& settings,
                                              const std::vector<double>& null, assembly::Workspace& workspace) {
  const Place& place = extended.additions().front().place;
  if (!place.channel.empty() && !mechanism.question_only) {
    double span = 0;
    for (const assembly::MeasuredChannel& view : extended.assembly().layout().channels)
      if (view.test == place.tests.front() && view.observable == place.channel) span = span_of(view);
    if (!(span > 0)) return std::nullopt;
    const double null_amplitude = mechanism.null, bound = beyond_plausible * span;
    return AmplitudeRange{null_amplitude - span, null_amplitude + span, null_amplitude - bound, null_amplitude + bound};
  }
  if (!(mechanism.plausible_effect > 0)) return std::nullopt;
  double most = 0;
  for (const MechanismFactory::Setting& setting : settings) {
    const std::vector<double> effect =
        effect_of(extended, mechanism, with_setting(extended, mechanism, setting, null), workspace);
    if (!effect.empty()) most = std::max(most, filling_amplitude(extended.assembly().layout(), effect));
  }
  if (!(most > 0)) return std::nullopt;
  return around(mechanism, mechanism.plausible_effect * most);
}

}  // namespace tunica::diagnosis
