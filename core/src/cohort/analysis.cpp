// SPDX-License-Identifier: Apache-2.0
#include "cohort/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cohort/index.hpp"
#include "numerics/distributions.hpp"
#include "population/power.hpp"

namespace tunica::cohort {

namespace {

/// ξ ± t se, as the coordinate is read: e^ξ where it is logarithmic.
Estimated estimated(double xi, double se, double freedom, Scale scale) {
  const double half = numerics::student_quantile(0.975, freedom) * se;
  if (scale == Scale::log) return {std::exp(xi), std::exp(xi - half), std::exp(xi + half)};
  return {xi, xi - half, xi + half};
}

/// The interval of a group has the least freedom of the columns that it takes part in.
double freedom_of(const Design& design, const Eigen::VectorXd& row) {
  double least = design.freedom(0);
  for (Eigen::Index k = 1; k < row.size(); ++k)
    if (row[k] != 0) least = std::min(least, design.freedom(k));
  return least;
}

void add_means(const AnalysisInput& input, Analysis& analysis) {
  for (std::size_t j = 0; j < analysis.coordinates.size(); ++j) {
    auto& of_groups = analysis.means.emplace_back();
    for (const Design::Group& group : analysis.groups) {
      const double se = std::sqrt(input.estimates.mean_covariance(group.row)(index(j), index(j)));
      of_groups.push_back(estimated(input.estimates.mean(group.row)[index(j)], se, freedom_of(input.design, group.row),
                                    analysis.coordinates[j].scale));
    }
  }
}

void add_spreads(const AnalysisInput& input, Analysis& analysis) {
  const auto intervals = population::spread_intervals(input.individuals, input.structure, input.estimates);
  for (std::size_t j = 0; j < analysis.coordinates.size(); ++j)
    analysis.spreads.push_back({std::sqrt(input.estimates.omega(index(j), index(j))), intervals[j].lower,
                                intervals[j].upper, std::sqrt(input.estimates.omega_animals(index(j), index(j)))});
}

void add_effects(const AnalysisInput& input, Analysis& analysis) {
  const Eigen::Index p = index(analysis.coordinates.size());
  for (std::size_t f = 0; f < input.design.factors.size(); ++f) {
    const DesignFactor& factor = input.design.factors[f];
    for (std::size_t level = 1; level < factor.levels.size(); ++level) {
      const Eigen::Index column = factor.columns.first + index(level) - 1;
      for (std::size_t j = 0; j < analysis.coordinates.size(); ++j) {
        const Eigen::Index at = column * p + index(j);
        const double b = input.estimates.B(index(j), column), se = std::sqrt(input.estimates.covariance(at, at));
        const Scale scale = analysis.coordinates[j].scale;
        Effect effect{factor.name,
                      factor.levels[level],
                      factor.reference,
                      analysis.coordinates[j].name,
                      scale == Scale::log,
                      {},
                      input.design.freedom(column),
                      1,
                      1,
                      {},
                      {}};
        effect.size = estimated(b, se, effect.freedom, scale);
        effect.p = 2 * numerics::student_above(std::abs(b) / se, effect.freedom);
        analysis.effects.push_back(effect);
      }
    }
  }
}

/// S. Holm, Scand. J. Statist. 6:65 (1979), over the effects of one factor.
void adjust(std::vector<Effect>& effects, const std::string& factor) {
  std::vector<Effect*> of_factor;
  for (Effect& effect : effects)
    if (effect.factor == factor) of_factor.push_back(&effect);
  std::stable_sort(of_factor.begin(), of_factor.end(), [](const Effect* a, const Effect* b) { return a->p < b->p; });
  double largest = 0;
  for (std::size_t k = 0; k < of_factor.size(); ++k) {
    largest = std::max(largest, static_cast<double>(of_factor.size() - k) * of_factor[k]->p);
    of_factor[k]->p_holm = std::min(1.0, largest);
  }
}

FactorTest test_of(const AnalysisInput& input, std::size_t f) {
  const DesignFactor& factor = input.design.factors[f];
  FactorTest test{factor.name, 0, 0, 1, {}};
  const Design reduced = input.design.without(f);
  // Both likelihoods of the same expansions.
  std::vector<population::Individual> without = input.individuals;
  for (std::size_t i = 0; i < without.size(); ++i) without[i].design = reduced.rows.row(index(i)).transpose();
  const auto likelihood = [&](const std::vector<population::Individual>& individuals) {
    return population::estimate(individuals, input.structure, {}, false).neg2_likelihood;
  };
  test.likelihood_ratio = std::max(0.0, likelihood(without) - likelihood(input.individuals));
  test.freedom = static_cast<double>(input.estimates.B.rows() * (index(factor.levels.size()) - 1));
  test.p = numerics::chi_squared_above(test.likelihood_ratio, test.freedom);
  if (input.permutations == 0) return test;
  NullModel null = input.null(f);
  for (std::size_t i = 0; i < null.individuals.size(); ++i)
    null.individuals[i].design = input.design.rows.row(index(i)).transpose();
  test.permutation =
      population::permutation_test(null.individuals, factor.columns, null.estimates, input.permutations, input.seed);
  return test;
}

void add_planning(const AnalysisInput& input, Analysis& analysis) {
  const Design::Group& group = analysis.groups.front();
  const auto n = static_cast<double>(group.specimens.size());
  if (n < 2 || input.design.specimens.size() < 4) return;
  for (std::size_t j = 0; j < analysis.coordinates.size(); ++j) {
    const double variance = n * input.estimates.mean_covariance(group.row)(index(j), index(j));
    Planning planning;
    planning.detectable =
        population::detectable_difference(variance, 0.5 * static_cast<double>(input.design.specimens.size()));
    if (analysis.coordinates[j].scale == Scale::log) {
      planning.detectable = std::exp(planning.detectable);
      planning.for_fifth = population::specimens_needed(std::log(1.2), variance);
      planning.for_half = population::specimens_needed(std::log(1.5), variance);
    }
    analysis.planning.push_back(planning);
  }
}

}  // namespace

Analysis analyse(std::vector<Coordinate> coordinates, const AnalysisInput& input) {
  Analysis analysis;
  analysis.coordinates = std::move(coordinates);
  analysis.groups = input.design.groups();
  add_means(input, analysis);
  add_spreads(input, analysis);
  add_effects(input, analysis);
  for (std::size_t f = 0; f < input.design.factors.size(); ++f) {
    analysis.factors.push_back(test_of(input, f));
    const FactorTest& test = analysis.factors.back();
    adjust(analysis.effects, test.factor);
    if (test.permutation.made == 0) continue;
    for (Effect& effect : analysis.effects) {
      if (effect.factor != test.factor) continue;
      const auto j =
          static_cast<std::size_t>(std::find_if(analysis.coordinates.begin(), analysis.coordinates.end(),
                                                [&](const Coordinate& one) { return one.name == effect.of; }) -
                                   analysis.coordinates.begin());
      effect.p_permutation = test.permutation.p[j];
      effect.p_adjusted = test.permutation.p_any[j];
    }
  }
  add_planning(input, analysis);
  return analysis;
}

}  // namespace tunica::cohort
