// SPDX-License-Identifier: Apache-2.0
#include "cohort/analysis.hpp"

#include <algorithm>
#include <cmath>

#include "cohort/index.hpp"
#include "numerics/distributions.hpp"
#include "population/power.hpp"
#include "population/predictive.hpp"

namespace tunica::cohort {

namespace {

/// As the coordinate is read: e^ξ where it is logarithmic.
Estimated natural(double xi, double half, Scale scale) {
  if (scale == Scale::log) return {std::exp(xi), std::exp(xi - half), std::exp(xi + half)};
  return {xi, xi - half, xi + half};
}

void add_means(const Members& members, const population::Population& population, Analysis& analysis) {
  for (std::size_t j = 0; j < analysis.coordinates.size(); ++j) analysis.means.emplace_back();
  for (const Group& group : members.groups) {
    const population::Predictive at = population::predictive(population, group.levels);
    const double quantile = numerics::student_quantile(0.975, at.freedom);
    for (std::size_t j = 0; j < analysis.coordinates.size(); ++j)
      analysis.means[j].push_back(natural(at.mean[index(j)],
                                          quantile * std::sqrt(at.mean_covariance(index(j), index(j))),
                                          analysis.coordinates[j].scale));
  }
}

void add_spreads(const population::Population& population, Analysis& analysis) {
  analysis.spreads.resize(analysis.coordinates.size());
  for (const population::Spread& spread : population.spreads) {
    SpreadSummary& of = analysis.spreads[spread.parameter];
    if (spread.between) {
      of.of_animals = spread.value;
      continue;
    }
    of.sd = spread.value;
    of.lower = spread.interval.lower;
    if (std::isfinite(spread.interval.upper)) of.upper = spread.interval.upper;
  }
}

void add_factor(const population::Factor& factor, const population::FactorTest& test, Analysis& analysis) {
  for (const population::Effect& effect : test.effects) {
    const std::size_t j = effect.difference.parameter;
    const population::ParameterTest& of = test.parameters[j];
    const Scale scale = analysis.coordinates[j].scale;
    const double half = 0.5 * (effect.difference.interval.upper - effect.difference.interval.lower);
    analysis.effects.push_back({factor.name, factor.levels[effect.level], factor.levels.front(),
                                analysis.coordinates[j].name, scale == Scale::log,
                                natural(effect.difference.value, half, scale), effect.difference.freedom,
                                effect.difference.p_value, of.holm, of.permutation, of.westfall_young});
  }
  analysis.factors.push_back({factor.name, test.likelihood_ratio, test.permutation});
}

void add_planning(const population::Population& population, Analysis& analysis) {
  const std::size_t units = population.animals.empty() ? population.individuals.size() : population.animals.size();
  if (units < 4) return;
  for (const population::ParameterPower& one : population::deviations(population)) {
    Planning planning;
    if (!std::isfinite(one.deviation)) {
      analysis.planning.clear();
      return;
    }
    planning.detectable = population::detectable(one.deviation, units / 2);
    if (analysis.coordinates[one.parameter].scale == Scale::log) {
      planning.detectable = std::exp(planning.detectable);
      planning.for_fifth = population::needed(one.deviation, std::log(1.2));
      planning.for_half = population::needed(one.deviation, std::log(1.5));
    }
    analysis.planning.push_back(planning);
  }
}

}  // namespace

Analysis analyse(std::vector<Coordinate> coordinates, const Members& members, const population::Cohort& cohort,
                 const population::Population& population, std::size_t permutations, std::uint64_t seed) {
  Analysis analysis;
  analysis.coordinates = std::move(coordinates);
  for (const Group& group : members.groups) analysis.groups.push_back(group.name);
  add_means(members, population, analysis);
  add_spreads(population, analysis);
  for (std::size_t f = 0; f < cohort.factors.size(); ++f)
    add_factor(cohort.factors[f], population::test_factor(cohort, population, f, {permutations, seed}), analysis);
  add_planning(population, analysis);
  return analysis;
}

}  // namespace tunica::cohort
