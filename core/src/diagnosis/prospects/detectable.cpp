// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/prospects/detectable.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/hypotheses/amplitude_range.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double power_80 = 0.8416;     ///< quantile of the normal distribution
constexpr double identified_at = 5.41;  ///< 2 · 1.645²: one of two is preferred with 95 % probability
constexpr double equal_above = 0.999;

/// How far a plausible amplitude may lie from its null, in the unit of what it acts on.
double reach_of(const MechanismFactory& mechanism, const Addition& addition) {
  const AmplitudeRange range = range_of(mechanism, addition);
  return std::max(range.plausible_max - mechanism.null, mechanism.null - range.plausible_min);
}

/// Amplitudes of what acts on a channel have the channel's unit.
std::string amplitude_unit(const assembly::Assembly& base, const MechanismFactory& mechanism, const Place& place) {
  for (const assembly::MeasuredChannel& view : base.layout().channels)
    if (!place.channel.empty() && view.test == place.tests.front() && view.observable == place.channel)
      return view.unit;
  return mechanism.parameters.front().unit;
}

/// The place where the mechanism's largest plausible amplitude has the largest effect, by the slope at the null. Of its
/// nuisance settings, whose scales may differ by orders of magnitude, it takes the middle one. Null if the mechanism
/// has no effect anywhere.
const Direction* typical(const Hypotheses& hypotheses, std::size_t candidate) {
  struct Best {
    const Direction* direction;
    float effect;  ///< to seven digits: of places that are equal but for rounding the first
  };
  std::vector<Best> best;  // one a setting
  for (const Direction& direction : hypotheses.directions) {
    if (direction.candidate != candidate) continue;
    const Hypothesis& own = hypotheses.hypothesis(direction);
    if (own.addition.place.row || own.at_large) continue;
    const double reach = reach_of(*own.mechanism, own.addition);
    const auto effect = static_cast<float>(direction.length * (std::isfinite(reach) ? reach : 1));
    const auto same = std::find_if(best.begin(), best.end(), [&](const Best& other) {
      return hypotheses.hypothesis(*other.direction).addition.setting == own.addition.setting;
    });
    if (same == best.end())
      best.push_back({&direction, effect});
    else if (effect > same->effect)
      *same = {&direction, effect};
  }
  if (best.empty()) return nullptr;
  std::stable_sort(best.begin(), best.end(), [](const Best& a, const Best& b) { return a.effect < b.effect; });
  return best[best.size() / 2].direction;
}

}  // namespace

std::vector<Detectable> detectable(const Inquiry& inquiry, const Analysis& analysis) {
  const assembly::Assembly& base = *analysis.evidence.base;
  const Hypotheses& hypotheses = analysis.hypotheses;
  std::vector<Detectable> found;
  for (std::size_t c = 0; c < hypotheses.candidates.size(); ++c) {
    const Candidate& candidate = hypotheses.candidates[c];
    Detectable entry;
    entry.id = candidate.id;
    entry.unit = candidate.mechanism->parameters.front().unit;
    entry.null = candidate.mechanism->null;
    entry.one_sided = candidate.mechanism->side == MechanismFactory::Side::positive;
    entry.reach = reach_of(*candidate.mechanism, {});
    const Direction* const best = typical(hypotheses, c);
    if (!best) {
      entry.absence = candidate.absent.empty() ? Absence::absorbed : candidate.absence;
      entry.absent = candidate.absent.empty() ? "a refit of the parameters absorbs it" : candidate.absent;
      entry.detectable = std::numeric_limits<double>::infinity();
      entry.identifiable = std::numeric_limits<double>::infinity();
      found.push_back(std::move(entry));
      continue;
    }
    entry.place = candidate.hypotheses[best->hypothesis].addition.place;
    entry.retained = best->retained;
    entry.unit = amplitude_unit(base, *candidate.mechanism, entry.place);
    entry.reach = reach_of(*candidate.mechanism, candidate.hypotheses[best->hypothesis].addition);
    for (const Direction& other : hypotheses.directions) {
      if (other.candidate == c) continue;
      const double c_abs = std::min(1.0, std::abs(best->unit.dot(other.unit)));
      if (c_abs > entry.correlation) {
        entry.correlation = c_abs;
        entry.closest = hypotheses.candidates[other.candidate].id;
      }
    }
    const auto amplitude = [&](double Lambda) {
      const double delta = std::sqrt(Lambda) / best->length;
      return best->side == MechanismFactory::Side::even ? std::sqrt(delta) : delta;
    };
    const double T = analysis.alarm.detector->threshold(c, inquiry.request.alpha);
    const double Lambda = std::pow(std::sqrt(T) + power_80, 2);
    entry.detectable = amplitude(Lambda);
    entry.identifiable = entry.correlation > equal_above
                             ? std::numeric_limits<double>::infinity()
                             : amplitude(std::max(Lambda, identified_at / (1 - entry.correlation)));
    found.push_back(std::move(entry));
  }
  return found;
}

}  // namespace tunica::diagnosis
