// SPDX-License-Identifier: Apache-2.0
#include "population/power.hpp"

#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "numerics/distributions.hpp"

namespace tunica::population {

std::vector<ParameterPower> deviations(const Population& population) {
  const auto marginals = integrate_specimens(population.alternation.expansions, population.alternation.variances);
  const Eigen::Index p = population.omega.rows();
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(p, p);
  for (const Marginal& marginal : marginals) W += marginal.W / static_cast<double>(marginals.size());
  const Eigen::FullPivLU<Eigen::MatrixXd> solver(W);
  std::vector<ParameterPower> result;
  const Eigen::MatrixXd variance = solver.isInvertible() ? Eigen::MatrixXd(solver.inverse()) : Eigen::MatrixXd();
  const double each = population.animals.empty()
                          ? 1
                          : static_cast<double>(marginals.size()) / static_cast<double>(population.animals.size());
  for (Eigen::Index j = 0; j < p; ++j) {
    double own = variance.size() > 0 ? variance(j, j) / each : std::numeric_limits<double>::infinity();
    if (population.omega_between.size() > 0) own += population.omega_between(j, j);
    result.push_back({static_cast<std::size_t>(j), std::sqrt(own)});
  }
  return result;
}

double power_of(double deviation, double difference, std::size_t n, double level) {
  const double size = static_cast<double>(n), freedom = 2 * size - 2;
  const double away = std::abs(difference) / (deviation * std::sqrt(2 / size));
  if (!std::isfinite(away)) return deviation == 0 ? 1 : level;
  if (away > 30) return 1;
  const double edge = numerics::student_quantile(1 - level / 2, freedom);
  return numerics::noncentral_student_above(edge, freedom, away) +
         numerics::noncentral_student_above(edge, freedom, -away);
}

std::optional<std::size_t> needed(double deviation, double difference, double power, double level, std::size_t most) {
  if (!(power_of(deviation, difference, most, level) >= power)) return {};
  std::size_t low = 1, high = most;  // too few, enough
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (power_of(deviation, difference, middle, level) >= power ? high : low) = middle;
  }
  return high;
}

double detectable(double deviation, std::size_t n, double power, double level) {
  if (!std::isfinite(deviation)) return deviation;
  double low = 0, high = deviation;
  while (power_of(deviation, high, n, level) < power) high *= 2;
  while (high - low > 1e-9 * high) {
    const double middle = (low + high) / 2;
    (power_of(deviation, middle, n, level) >= power ? high : low) = middle;
  }
  return high;
}

}  // namespace tunica::population
