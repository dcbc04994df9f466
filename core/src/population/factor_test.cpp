// SPDX-License-Identifier: Apache-2.0
#include "population/factor_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <oneapi/tbb/parallel_for.h>

#include "numerics/cholesky.hpp"
#include "numerics/distributions.hpp"
#include "population/multiplicity.hpp"

namespace tunica::population {
namespace {

/// Columns of a factor in a design, as numbers.
std::vector<std::size_t> columns_of(const Design& design, std::size_t factor) {
  std::vector<std::size_t> result;
  for (std::size_t c = 0; c < design.size(); ++c)
    if (design.columns[c].factor == factor) result.push_back(c);
  return result;
}

/// β·C⁻¹β of some coefficients.
double wald(const Eigen::VectorXd& beta, const Eigen::MatrixXd& covariance, const std::vector<Eigen::Index>& places) {
  const Eigen::VectorXd own = beta(places);
  return own.dot(numerics::solve_symmetric(covariance(places, places), own));
}

struct Statistics {
  double whole = 0;
  std::vector<double> parameters;
};

std::vector<Eigen::Index> places_of(const std::vector<std::size_t>& columns, std::size_t p, std::size_t parameter) {
  std::vector<Eigen::Index> result;
  for (const std::size_t c : columns) result.push_back(static_cast<Eigen::Index>(c * p + parameter));
  return result;
}

Statistics statistics(const Eigen::VectorXd& beta, const Eigen::MatrixXd& covariance,
                      const std::vector<std::size_t>& columns, std::size_t p) {
  Statistics result;
  std::vector<Eigen::Index> all;
  for (std::size_t j = 0; j < p; ++j) {
    const auto places = places_of(columns, p, j);
    result.parameters.push_back(wald(beta, covariance, places));
    all.insert(all.end(), places.begin(), places.end());
  }
  result.whole = wald(beta, covariance, all);
  return result;
}

/// The null fit, and Wald's statistics at its variances for any arrangement of the labels.
struct Null {
  const Cohort& cohort;
  Design full;
  std::vector<std::size_t> columns;
  Alternation fit;
  std::vector<Marginal> marginals;
  std::vector<std::size_t> animal_of;

  Statistics at(const std::vector<std::size_t>& levels) const {
    Eigen::MatrixXd rows = full.rows;
    for (const std::size_t c : columns)
      for (std::size_t i = 0; i < levels.size(); ++i)
        rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = levels[i] == full.columns[c].level ? 1 : 0;
    const Means means =
        integrate_means(marginals, rows, animal_of, fit.variances.between, Likelihood::restricted, false);
    const std::size_t p = cohort.parameters.size();
    // Labels that no data can tell apart count against the effect.
    if (!means.fixed)
      return {std::numeric_limits<double>::infinity(), std::vector<double>(p, std::numeric_limits<double>::infinity())};
    return statistics(means.beta, means.covariance, columns, p);
  }
};

bool reaches(double value, double observed) { return value >= observed * (1 - 1e-9); }

/// Share of arrangements whose value reaches the observed one; draws count the observed arrangement as one more.
double share(std::size_t reached, const Arrangements& drawn) {
  const double extra = drawn.exhaustive ? 0 : 1;
  return (static_cast<double>(reached) + extra) / (static_cast<double>(drawn.levels.size()) + extra);
}

/// Step-down maxima: the parameter with the largest T against the maxima over all, the next against those over the
/// rest, and so on; p-values never fall on the way.
void westfall_young(const Statistics& observed, const std::vector<Statistics>& drawn, const Arrangements& arrangements,
                    std::vector<ParameterTest>& tests) {
  const std::size_t p = observed.parameters.size();
  std::vector<std::size_t> order(p);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return observed.parameters[a] > observed.parameters[b]; });
  std::vector<std::size_t> reached(p, 0), alone(p, 0);
  for (const Statistics& one : drawn) {
    double largest = -1;
    for (std::size_t k = p; k-- > 0;) {
      const std::size_t j = order[k];
      largest = std::max(largest, one.parameters[j]);
      reached[k] += reaches(largest, observed.parameters[j]);
      alone[j] += reaches(one.parameters[j], observed.parameters[j]);
    }
  }
  double highest = 0;
  for (std::size_t k = 0; k < p; ++k) {
    highest = std::max(highest, share(reached[k], arrangements));
    tests[order[k]].westfall_young = highest;
    tests[order[k]].permutation = share(alone[order[k]], arrangements);
  }
}

void permute(const Null& null, std::size_t factor, const std::vector<std::size_t>& others,
             const FactorTestOptions& options, FactorTest& result) {
  const Arrangements drawn = arrangements(null.cohort, factor, others, options.permutations, options.seed);
  std::vector<std::size_t> own;
  for (const Specimen& specimen : null.cohort.specimens) own.push_back(specimen.levels[factor]);
  const Statistics observed = null.at(own);
  std::vector<Statistics> values(drawn.levels.size());
  tbb::parallel_for(std::size_t{0}, values.size(), [&](std::size_t k) { values[k] = null.at(drawn.levels[k]); });
  std::size_t reached = 0, largest = 0;
  double top = 0;
  for (const Statistics& one : values) top = std::max(top, one.whole);
  for (const Statistics& one : values) {
    reached += reaches(one.whole, observed.whole);
    largest += reaches(one.whole, top);
  }
  result.permutation = {drawn.scheme,
                        drawn.possible,
                        drawn.exhaustive,
                        drawn.levels.size(),
                        options.seed,
                        share(reached, drawn),
                        share(drawn.exhaustive ? largest : 0, drawn)};
  westfall_young(observed, values, drawn, result.parameters);
}

/// Effects, ratios and parametric p-values of the model with the factor.
void read_effects(const Cohort& cohort, const Population& population, const std::vector<std::size_t>& columns,
                  FactorTest& result) {
  const std::size_t p = cohort.parameters.size();
  std::vector<double> p_values;
  for (const std::size_t c : columns)
    for (std::size_t j = 0; j < p; ++j) {
      Effect effect{population.coefficients[c * p + j], population.design.columns[c].level, {}, {}};
      if (cohort.parameters[j].logarithmic) {
        effect.ratio = std::exp(effect.difference.value);
        effect.ratio_interval = {std::exp(effect.difference.interval.lower),
                                 std::exp(effect.difference.interval.upper)};
      }
      result.effects.push_back(effect);
    }
  const Statistics values = statistics(population.beta, population.beta_covariance, columns, p);
  for (std::size_t j = 0; j < p; ++j) {
    ParameterTest test{j, 0, static_cast<double>(columns.size()), population.coefficients[columns.front() * p].freedom};
    test.f = values.parameters[j] / test.freedom;
    test.p_value = numerics::f_above(test.f, test.freedom, test.freedom_below);
    p_values.push_back(test.p_value);
    result.parameters.push_back(test);
  }
  const std::vector<double> adjusted = holm(p_values);
  for (std::size_t j = 0; j < p; ++j) result.parameters[j].holm = adjusted[j];
}

}  // namespace

FactorTest test_factor(const Cohort& given, const Population& population, std::size_t factor,
                       const FactorTestOptions& options) {
  const Sorted sorted = population::sorted(given);
  const Cohort& cohort = sorted.cohort;
  FactorTest result;
  result.factor = factor;
  const std::vector<std::size_t> columns = columns_of(population.design, factor);
  read_effects(given, population, columns, result);
  std::vector<std::size_t> others;
  for (const Column& column : population.design.columns)
    if (column.factor && *column.factor != factor && (others.empty() || others.back() != *column.factor))
      others.push_back(*column.factor);
  Form form{design(cohort, others), population.within.shape, {}, Likelihood::restricted};
  if (population.between) form.between = population.between->shape;
  Null null{cohort, population.design, columns, alternate(cohort, form), {}, {}};
  null.marginals = integrate_specimens(null.fit.expansions, null.fit.variances);
  for (std::size_t i = 0; i < cohort.specimens.size() && !cohort.animals.empty(); ++i)
    null.animal_of.push_back(cohort.specimens[i].animal);
  permute(null, factor, others, options, result);
  form.likelihood = Likelihood::full;
  const double without = refitted(cohort, form, null.fit).maximum.value;
  form.design = population.design;
  const double with = refitted(cohort, form, null.fit).maximum.value;
  const double freedom = static_cast<double>(columns.size() * cohort.parameters.size());
  const double statistic = std::max(without - with, 0.0);
  result.likelihood_ratio = {statistic, freedom, numerics::chi_squared_above(statistic, freedom)};
  return result;
}

}  // namespace tunica::population
