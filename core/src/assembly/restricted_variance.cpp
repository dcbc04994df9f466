// SPDX-License-Identifier: Apache-2.0
#include "assembly/restricted_variance.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace tunica::assembly {
namespace {

constexpr double settled = 1e-5;  ///< of ln s_g
constexpr double hardly_any_freedom = 1e-9;

}  // namespace

RestrictedVariance restricted_variance(const VarianceProblem& problem, std::size_t steps) {
  const Eigen::Index n = problem.residuals.size();
  std::size_t groups = 0;
  for (const std::size_t g : problem.group)
    if (g != known_variance) groups = std::max(groups, g + 1);
  RestrictedVariance found;
  found.variance.assign(groups, 1);
  found.at_least.assign(groups, false);
  const auto least = [&](std::size_t g) { return g < problem.least.size() ? problem.least[g] : 0.0; };
  // The search begins without any loss to the columns.
  std::vector<double> squares(groups, 0), rows(groups, 0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t g = problem.group[static_cast<std::size_t>(i)];
    if (g == known_variance) continue;
    squares[g] += problem.residuals[i] * problem.residuals[i] / problem.shape[i];
    rows[g] += 1;
  }
  for (std::size_t g = 0; g < groups; ++g)
    if (squares[g] > 0) found.variance[g] = std::max(squares[g] / rows[g], least(g));

  for (std::size_t step = 0; step <= steps; ++step) {
    Eigen::VectorXd weight(n);
    double log_variance = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::size_t g = problem.group[static_cast<std::size_t>(i)];
      const double variance = problem.shape[i] * (g == known_variance ? 1 : found.variance[g]);
      weight[i] = 1 / std::sqrt(variance);
      log_variance += std::log(variance);
    }
    const Eigen::VectorXd r = weight.cwiseProduct(problem.residuals);
    Eigen::MatrixXd A = weight.asDiagonal() * problem.columns;
    found.leverage = Eigen::VectorXd::Zero(n);
    found.remainder = r;
    double log_information = 0;
    if (A.cols() > 0) {
      Eigen::MatrixXd information = Eigen::MatrixXd::Zero(A.cols(), A.cols());
      information.selfadjointView<Eigen::Lower>().rankUpdate(A.transpose());
      const Eigen::LLT<Eigen::MatrixXd> factor(information);
      const Eigen::MatrixXd X = factor.matrixL().solve(A.transpose());  // columns of length √leverage
      found.leverage = X.colwise().squaredNorm().transpose();
      found.remainder -= X.transpose() * (X * r);
      log_information = 2 * factor.matrixLLT().diagonal().array().log().sum();
    }
    found.misfit = log_variance + log_information + found.remainder.squaredNorm();
    found.freedom.assign(groups, 0);
    std::fill(squares.begin(), squares.end(), 0);
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::size_t g = problem.group[static_cast<std::size_t>(i)];
      if (g == known_variance) continue;
      found.freedom[g] += std::max(0.0, 1 - found.leverage[i]);
      squares[g] += found.remainder[i] * found.remainder[i];
    }
    double moved = 0;
    if (step == steps) break;
    for (std::size_t g = 0; g < groups; ++g) {
      if (!(found.freedom[g] > hardly_any_freedom)) continue;
      const double before = found.variance[g];
      const double now = std::max({before * squares[g] / found.freedom[g], least(g), 1e-12 * before});
      found.at_least[g] = now <= least(g);
      if (found.at_least[g] && before <= least(g)) continue;
      moved = std::max(moved, std::abs(std::log(now / before)));
      found.variance[g] = now;
    }
    if (moved < settled) break;
  }
  return found;
}

double value_step(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  if (sorted.size() < 4) return 0;
  const double largest = std::max(std::abs(sorted.front()), std::abs(sorted.back()));
  const double digits = 1e-6 * largest;
  double step = 0;
  std::size_t different = 1;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double gap = sorted[i] - sorted[i - 1];
    if (gap <= digits) continue;
    ++different;
    step = step == 0 ? gap : std::min(step, gap);
  }
  if (step == 0 || 4 * different > 3 * sorted.size()) return 0;
  constexpr double off = 0.02;  // of a step
  for (const double value : sorted)
    if (std::abs(value / step - std::round(value / step)) > off + digits / step) return 0;
  return step;
}

}  // namespace tunica::assembly
