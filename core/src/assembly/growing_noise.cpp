// SPDX-License-Identifier: Apache-2.0
#include "assembly/growing_noise.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::assembly {

namespace {

constexpr double least_fraction = 0.1;  ///< of the variance at the largest level; a smaller growing part counts as none
constexpr double next_to_none = 1e-9;   ///< degrees of freedom

/// (level/largest level of the group)² of every row; 0 where the variance is known.
Eigen::VectorXd squared_levels(const VarianceProblem& problem, const Eigen::VectorXd& level, std::size_t groups) {
  std::vector<double> largest(groups, 0);
  const auto group_of = [&](Eigen::Index i) { return problem.group[static_cast<std::size_t>(i)]; };
  for (Eigen::Index i = 0; i < level.size(); ++i)
    if (group_of(i) != known_variance) largest[group_of(i)] = std::max(largest[group_of(i)], std::abs(level[i]));
  Eigen::VectorXd squared = Eigen::VectorXd::Zero(level.size());
  for (Eigen::Index i = 0; i < level.size(); ++i)
    if (group_of(i) != known_variance && largest[group_of(i)] > 0)
      squared[i] = std::pow(level[i] / largest[group_of(i)], 2);
  return squared;
}

/// The derivative of the likelihood by a share common to all variances, at share 0. A share is sought only if rows of a
/// large level have larger errors than others of their group.
double slope_at_none(const VarianceProblem& problem, const Eigen::VectorXd& squared) {
  const RestrictedVariance now = restricted_variance(problem);
  const auto group_of = [&](Eigen::Index i) { return problem.group[static_cast<std::size_t>(i)]; };
  std::vector<double> mean(now.variance.size(), 0);
  for (Eigen::Index i = 0; i < squared.size(); ++i)
    if (group_of(i) != known_variance)
      mean[group_of(i)] += (1 - now.leverage[i]) * squared[i] / std::max(now.freedom[group_of(i)], next_to_none);
  double slope = 0;
  for (Eigen::Index i = 0; i < squared.size(); ++i)
    if (group_of(i) != known_variance)
      slope += (now.remainder[i] * now.remainder[i] - (1 - now.leverage[i])) * (squared[i] - mean[group_of(i)]);
  return slope;
}

}  // namespace

GrowingNoise growing_noise(VarianceProblem& problem, const std::vector<std::size_t>& family_of_group,
                           const Eigen::VectorXd& level, double price) {
  std::size_t families = 0;
  for (const std::size_t family : family_of_group) families = std::max(families, family + 1);
  GrowingNoise found;
  found.share.assign(families, 0);
  if (families == 0) return found;
  const Eigen::VectorXd squared = squared_levels(problem, level, family_of_group.size());
  const auto factors = [&](const std::vector<double>& of_family) {
    Eigen::VectorXd factor = Eigen::VectorXd::Ones(squared.size());
    for (std::size_t i = 0; i < problem.group.size(); ++i)
      if (const std::size_t g = problem.group[i]; g != known_variance)
        factor[static_cast<Eigen::Index>(i)] += of_family[family_of_group[g]] * squared[static_cast<Eigen::Index>(i)];
    return factor;
  };
  VarianceProblem trial = problem;
  const auto misfit_with = [&](const std::vector<double>& of_family) {
    trial.shape = problem.shape.cwiseProduct(factors(of_family));
    constexpr std::size_t enough = 6;
    return restricted_variance(trial, enough).misfit;
  };
  const std::vector<double> grid{0, 0.5, 1.5, 4, 10, 30, 100};
  double now = misfit_with(found.share);
  std::vector<double> common = found.share;
  if (slope_at_none(problem, squared) > 0) {
    // Likelihoods L_s by share. A priori s = 0 is as probable as all others together; f = Σ L_s s/(1 + s)/Σ L_s.
    double all = 0, fraction = 0;
    for (const double share : grid) {
      const double gain = share == 0 ? 0 : now - misfit_with(std::vector(families, share));
      const double before = share == 0 ? static_cast<double>(grid.size() - 1) : 1;
      found.probability.push_back(before * std::exp(std::min(gain, 600.0) / 2));
      all += found.probability.back();
      fraction += found.probability.back() * share / (1 + share);
    }
    for (double& probability : found.probability) probability /= all;
    fraction /= all;
    if (fraction > least_fraction) common.assign(families, fraction / (1 - fraction));
    found.share = common;
    now = misfit_with(found.share);
  }
  for (std::size_t family = 0; families > 1 && family < families; ++family) {
    double best = now - price;
    std::vector<double> with = found.share, chosen = found.share;
    for (const double share : grid) {
      with[family] = share;
      if (const double misfit = misfit_with(with); misfit < best) {
        best = misfit;
        chosen = with;
      }
    }
    if (chosen != found.share) now = best;
    found.share = chosen;
  }
  found.variance.resize(squared.size(), static_cast<Eigen::Index>(found.probability.size()));
  for (std::size_t k = 0; k < found.probability.size(); ++k) {
    std::vector<double> if_so = found.share;
    for (std::size_t family = 0; family < families; ++family)
      if (found.share[family] == common[family]) if_so[family] = grid[k];
    found.variance.col(static_cast<Eigen::Index>(k)) = factors(if_so).cwiseQuotient(factors(found.share));
  }
  for (std::size_t g = 0; g < family_of_group.size(); ++g) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(found.variance.cols());
    double rows = 0;
    for (std::size_t i = 0; i < problem.group.size(); ++i)
      if (problem.group[i] == g) {
        sum += found.variance.row(static_cast<Eigen::Index>(i));
        rows += 1;
      }
    for (std::size_t i = 0; i < problem.group.size(); ++i)
      if (problem.group[i] == g) found.variance.row(static_cast<Eigen::Index>(i)).array() *= rows / sum.array();
  }
  problem.shape = problem.shape.cwiseProduct(factors(found.share)).eval();
  return found;
}

}  // namespace tunica::assembly
