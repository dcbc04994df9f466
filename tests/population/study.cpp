// SPDX-License-Identifier: Apache-2.0
#include "population/study.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <oneapi/tbb/parallel_for.h>

#include "population/factor_test.hpp"

namespace simulated {
namespace {

using namespace tunica::population;

Cohort drawn(const Setting& setting, double effect, std::uint64_t seed) {
  const Eigen::Index p = setting.curve->typical.size();
  Eigen::MatrixXd R = Eigen::MatrixXd::Constant(p, p, setting.correlated ? 0.5 : 0);
  R.diagonal().setOnes();
  const Eigen::MatrixXd root = setting.spread * Eigen::MatrixXd(R.llt().matrixL());
  Normal normal(seed);
  std::vector<Eigen::VectorXd> xi;
  for (std::size_t i = 0; i < setting.specimens; ++i) {
    const double shift = 2 * i >= setting.specimens ? effect : 0;
    xi.push_back(setting.curve->typical + root * normal.vector(p) + Eigen::VectorXd::Constant(p, shift));
  }
  Cohort result = cohort(*setting.curve, xi, normal);
  result.factors = {{"group", {"control", "treated"}}};
  for (std::size_t i = 0; i < setting.specimens; ++i) result.specimens[i].levels = {2 * i >= setting.specimens};
  return result;
}

bool any_found(const FactorTest& test) {
  for (const ParameterTest& one : test.parameters)
    if (one.westfall_young <= 0.05) return true;
  return false;
}

struct One {
  Population alone, groups;
  FactorTest none, some;
};

One run(const Setting& setting, std::uint64_t seed, std::size_t permutations) {
  One result;
  const Cohort same = drawn(setting, 0, seed), shifted = drawn(setting, setting.effect, seed);
  Options options;
  options.maximum_likelihood = false;
  result.alone = estimate(same, options);
  options.intervals_of_spreads = false;
  options.factors = {0};
  const FactorTestOptions draws{permutations, seed};
  result.none = test_factor(same, estimate(same, options), 0, draws);
  result.groups = estimate(shifted, options);
  result.some = test_factor(shifted, result.groups, 0, draws);
  return result;
}

void count(Share& share, bool hit) {
  share.hits += hit ? 1 : 0;
  share.of += 1;
}

bool covers(const Interval& interval, double truth) { return interval.lower <= truth && truth <= interval.upper; }

}  // namespace

Outcome study(const Setting& setting, std::size_t cohorts, std::uint64_t first_seed, std::size_t permutations) {
  const auto p = static_cast<std::size_t>(setting.curve->typical.size());
  std::vector<One> all(cohorts);
  tbb::parallel_for(std::size_t{0}, cohorts,
                    [&](std::size_t k) { all[k] = run(setting, first_seed + k, permutations); });
  Outcome result;
  result.means.resize(p);
  result.effects.resize(p);
  result.spreads.resize(p);
  result.spread_ratio.resize(p);
  result.borrowed.resize(p);
  for (const One& one : all) {
    for (std::size_t j = 0; j < p; ++j) {
      const auto at = static_cast<Eigen::Index>(j);
      count(result.means[j], covers(one.alone.coefficients[j].interval, setting.curve->typical[at]));
      count(result.effects[j], covers(one.some.effects[j].difference.interval, setting.effect));
      count(result.spreads[j], covers(one.alone.spreads[j].interval, setting.spread));
      result.spread_ratio[j] += one.alone.spreads[j].value / setting.spread / static_cast<double>(cohorts);
      result.borrowed[j] += one.alone.borrowed[at] / static_cast<double>(cohorts);
    }
    count(result.false_whole, one.none.permutation.p_value <= 0.05);
    count(result.false_any, any_found(one.none));
    count(result.found_any, any_found(one.some));
    result.unconverged += !one.alone.converged + !one.groups.converged;
  }
  return result;
}

}  // namespace simulated
