// SPDX-License-Identifier: Apache-2.0
#include "population/predictive.hpp"

#include <cmath>

#include <fmt/format.h>

#include "numerics/distributions.hpp"
#include "numerics/eigenpairs.hpp"
#include "population/chance.hpp"

namespace tunica::population {

Predictive predictive(const Population& population, const std::vector<std::size_t>& levels) {
  const Eigen::Index p = population.omega.rows();
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(p, population.beta.size());
  for (std::size_t c = 0; c < population.design.size(); ++c) {
    const Column& column = population.design.columns[c];
    if (!column.factor || levels.at(*column.factor) == column.level)
      X.middleCols(static_cast<Eigen::Index>(c) * p, p).diagonal().setOnes();
  }
  Predictive result;
  result.mean = X * population.beta;
  result.mean_covariance = X * population.beta_covariance * X.transpose();
  result.covariance = population.omega + result.mean_covariance;
  if (population.omega_between.size() > 0) result.covariance += population.omega_between;
  result.freedom = population.coefficients.front().freedom;
  return result;
}

Eigen::MatrixXd draws(const Predictive& predictive, std::uint64_t seed, std::size_t count) {
  const Eigen::Index p = predictive.mean.size();
  const numerics::Eigenpairs pairs = numerics::eigenpairs(predictive.covariance);
  const Eigen::MatrixXd root = pairs.vectors * pairs.values.cwiseMax(0).cwiseSqrt().asDiagonal();
  Eigen::MatrixXd result(p, static_cast<Eigen::Index>(count));
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    Chance chance(derive_seed(seed, fmt::format("new specimen {}", k + 1)));
    Eigen::VectorXd z(p);
    for (Eigen::Index j = 0; j < p; ++j) z[j] = numerics::normal_quantile(chance.open());
    const double chi = numerics::chi_squared_quantile(chance.open(), predictive.freedom);
    result.col(k) = predictive.mean + std::sqrt(predictive.freedom / chi) * (root * z);
  }
  return result;
}

}  // namespace tunica::population
