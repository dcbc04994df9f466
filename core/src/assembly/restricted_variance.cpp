// SPDX-License-Identifier: Apache-2.0
#include "assembly/restricted_variance.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace tunica::assembly {
namespace {

constexpr double settled = 1e-5;  ///< of ln s_g
constexpr double next_to_none = 1e-9;

/// Largest |level| of the rows of each family.
std::vector<double> largest_levels(const VarianceProblem& problem, const std::vector<std::size_t>& family_of_group,
                                   const Eigen::VectorXd& level, std::size_t families) {
  std::vector<double> largest(families, 0);
  for (std::size_t i = 0; i < problem.group.size(); ++i)
    if (problem.group[i] != known_variance) {
      double& most = largest[family_of_group[problem.group[i]]];
      most = std::max(most, std::abs(level[static_cast<Eigen::Index>(i)]));
    }
  return largest;
}

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
  // Where the search begins: nothing is lost to the columns.
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
      if (!(found.freedom[g] > next_to_none)) continue;
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

std::vector<double> restricted_shares(VarianceProblem& problem, const std::vector<std::size_t>& family_of_group,
                                      const Eigen::VectorXd& level, double price) {
  std::size_t families = 0;
  for (const std::size_t family : family_of_group) families = std::max(families, family + 1);
  std::vector<double> shares(families, 0);
  if (families == 0) return shares;
  const std::vector<double> largest = largest_levels(problem, family_of_group, level, families);
  const auto family_at = [&](Eigen::Index i) {
    const std::size_t g = problem.group[static_cast<std::size_t>(i)];
    return g == known_variance ? known_variance : family_of_group[g];
  };
  const auto shape_with = [&](std::size_t family, double share) {
    Eigen::VectorXd shape = problem.shape;
    for (Eigen::Index i = 0; i < shape.size(); ++i)
      if (family_at(i) == family) shape[i] *= 1 + share * std::pow(level[i] / largest[family], 2);
    return shape;
  };
  RestrictedVariance now = restricted_variance(problem);
  for (std::size_t family = 0; family < families; ++family) {
    if (!(largest[family] > 0)) continue;
    // The slope of the likelihood at a share of 0, groups apart: only where large rows err more is there one to look
    // for.
    std::vector<double> mean(now.variance.size(), 0);
    for (Eigen::Index i = 0; i < level.size(); ++i)
      if (family_at(i) == family) {
        const std::size_t g = problem.group[static_cast<std::size_t>(i)];
        mean[g] += (1 - now.leverage[i]) * level[i] * level[i] / std::max(now.freedom[g], next_to_none);
      }
    double slope = 0;
    for (Eigen::Index i = 0; i < level.size(); ++i)
      if (family_at(i) == family)
        slope += (now.remainder[i] * now.remainder[i] - (1 - now.leverage[i])) *
                 (level[i] * level[i] - mean[problem.group[static_cast<std::size_t>(i)]]);
    if (!(slope > 0)) continue;
    VarianceProblem trial = problem;
    double best = now.misfit - price;
    for (const double share : {0.5, 1.5, 4.0, 10.0, 30.0, 100.0}) {
      trial.shape = shape_with(family, share);
      const RestrictedVariance with = restricted_variance(trial, 6);
      if (with.misfit >= best) continue;
      best = with.misfit;
      shares[family] = share;
    }
    if (shares[family] == 0) continue;
    problem.shape = shape_with(family, shares[family]);
    now = restricted_variance(problem);
  }
  return shares;
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
