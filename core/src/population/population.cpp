// SPDX-License-Identifier: Apache-2.0
#include "population/population.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/distributions.hpp"
#include "population/integration.hpp"
#include "population/spread_profile.hpp"

namespace tunica::population {
namespace {

std::vector<Coefficient> coefficients_of(const Means& means, const std::vector<double>& freedom, std::size_t p,
                                         double confidence) {
  std::vector<Coefficient> result;
  for (std::size_t c = 0; c < freedom.size(); ++c)
    for (std::size_t j = 0; j < p; ++j) {
      const auto k = static_cast<Eigen::Index>(c * p + j);
      Coefficient own{j, c, means.beta[k], std::sqrt(means.covariance(k, k)), freedom[c], {}, 1};
      const double reach = numerics::student_quantile(0.5 + confidence / 2, own.freedom) * own.standard_error;
      own.interval = {own.value - reach, own.value + reach};
      if (c > 0) own.p_value = 2 * numerics::student_above(std::abs(own.value) / own.standard_error, own.freedom);
      result.push_back(own);
    }
  return result;
}

Evidence evidence(const Cohort& cohort, const Alternation& fit, Likelihood likelihood) {
  Evidence result;
  result.deviance = deviance(fit, likelihood);
  result.parameters = static_cast<double>(fit.maximum.x.size());
  if (likelihood == Likelihood::full) result.parameters += static_cast<double>(fit.means.beta.size());
  result.aic = result.deviance + 2 * result.parameters;
  result.bic = result.deviance + result.parameters * std::log(static_cast<double>(cohort.specimens.size()));
  return result;
}

void fill_individuals(const Sorted& sorted, const Integration& whole, Population& result) {
  const Alternation& fit = result.alternation;
  const auto marginals = integrate_specimens(whole.expansions, fit.variances);
  const Eigen::VectorXd variance = result.omega.diagonal();
  result.individuals.resize(marginals.size());
  result.borrowed.setZero(variance.size());
  for (std::size_t k = 0; k < marginals.size(); ++k) {
    Posterior own = posterior(marginals[k], whole.means.of_specimen[k], whole.means.of_specimen_covariance[k]);
    Individual& individual = result.individuals[sorted.place[k]];
    individual.borrowed.setOnes(variance.size());
    for (Eigen::Index j = 0; j < variance.size(); ++j)
      if (variance[j] > 0) individual.borrowed[j] = marginals[k].K(j, j) / variance[j];
    result.borrowed += individual.borrowed / static_cast<double>(marginals.size());
    individual.mean = std::move(own.mean);
    individual.covariance = std::move(own.covariance);
    individual.effect = std::move(own.effect);
  }
  for (const std::size_t k : fit.failures) result.individuals[sorted.place[k]].failed = true;
}

/// a_k in the caller's order; animals without a specimen have zero.
void fill_animals(const Cohort& given, const Sorted& sorted, const Integration& whole, Population& result) {
  const auto p = static_cast<Eigen::Index>(given.parameters.size());
  result.animals.assign(given.animals.size(), Eigen::VectorXd::Zero(p));
  for (std::size_t k = 0; k < sorted.place.size() && !given.animals.empty(); ++k)
    result.animals[given.specimens[sorted.place[k]].animal] = whole.means.animals[sorted.cohort.specimens[k].animal];
}

}  // namespace

Population estimate(const Cohort& given, const Options& options) {
  const Sorted sorted = population::sorted(given);
  const Cohort& cohort = sorted.cohort;
  const std::size_t p = cohort.parameters.size(), n = cohort.specimens.size(), animals = cohort.animals.size();
  Population result;
  result.place = sorted.place;
  result.design = design(cohort, options.factors);
  const std::vector<double> freedom = containment(result.design, n, animals);
  const double units = static_cast<double>(n - result.design.size());
  result.within = choose(options.within, p, units);
  if (animals > 0) result.between = choose(options.between, p, freedom.front());
  Form form{result.design, result.within.shape, {}, Likelihood::restricted};
  if (result.between) form.between = result.between->shape;
  result.alternation = alternate(cohort, form);
  const Alternation& fit = result.alternation;
  const Integration whole = integrate(cohort, form, fit);
  result.coefficients = coefficients_of(whole.means, freedom, p, options.confidence);
  result.beta = whole.means.beta;
  result.beta_covariance = whole.means.covariance;
  result.omega = fit.variances.within * fit.variances.within.transpose();
  if (animals > 0) result.omega_between = fit.variances.between * fit.variances.between.transpose();
  result.noise = fit.variances.noise;
  result.rounds = fit.rounds;
  result.converged = fit.converged;
  result.spreads = spreads(cohort, form, fit, options.intervals_of_spreads ? options.confidence : 0);
  fill_individuals(sorted, whole, result);
  fill_animals(given, sorted, whole, result);
  result.reml = evidence(cohort, fit, Likelihood::restricted);
  if (options.maximum_likelihood) {
    form.likelihood = Likelihood::full;
    result.ml = evidence(cohort, alternate(cohort, form, &fit), Likelihood::full);
  }
  return result;
}

}  // namespace tunica::population
