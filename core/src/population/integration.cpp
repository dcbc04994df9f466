// SPDX-License-Identifier: Apache-2.0
#include "population/integration.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <boost/random/sobol.hpp>
#include <oneapi/tbb/parallel_for.h>

#include "numerics/distributions.hpp"
#include "numerics/eigenpairs.hpp"

namespace tunica::population {
namespace {

constexpr Eigen::Index number_of_points = 256;
constexpr double narrow = 1.2, wide = 2;  // than the normal distribution of the linear model: tails are seen
constexpr double fewest = 10;             // effective points that a mean is made of
constexpr std::size_t newton_steps = 2;

/// p × points in (0, 1).
Eigen::MatrixXd sobol(Eigen::Index p) {
  boost::random::sobol sequence(static_cast<std::size_t>(p));
  Eigen::MatrixXd u(p, number_of_points);
  for (Eigen::Index s = 0; s < u.cols(); ++s)
    for (Eigen::Index j = 0; j < p; ++j)
      u(j, s) = (static_cast<double>(sequence()) + 0.5) / (static_cast<double>(boost::random::sobol::max()) + 1);
  return u;
}

/// Normal deviates: the points moved round by Weyl's sequence, which is another shift for each specimen and coordinate
/// (R. Cranley, T. N. L. Patterson, SIAM J. Numer. Anal. 13:904, 1976).
Eigen::MatrixXd deviates(const Eigen::MatrixXd& u, std::size_t specimen) {
  constexpr double golden = 0.61803398874989485;
  Eigen::MatrixXd z(u.rows(), u.cols());
  for (Eigen::Index j = 0; j < u.rows(); ++j) {
    const double shift = std::fmod(
        golden * (static_cast<double>(specimen) * static_cast<double>(u.rows()) + static_cast<double>(j + 1)), 1.0);
    for (Eigen::Index s = 0; s < u.cols(); ++s) {
      const double moved = u(j, s) + shift;
      z(j, s) = numerics::normal_quantile(std::clamp(moved - std::floor(moved), 1e-9, 1 - 1e-9));
    }
  }
  return z;
}

/// Steps of the sampling as columns of a root. In the eigenvectors v of P⁻½ A P⁻½ the linear model has the variance
/// 1/(1 + λ) of the prior's. Directions that the data fix are sampled little wider; open ones up to the prior's width.
Eigen::MatrixXd root_of_sampling(const Eigen::MatrixXd& A, const Eigen::MatrixXd& P) {
  const Eigen::MatrixXd root = P.llt().matrixU();  // P = Uᵀ U
  const Eigen::MatrixXd half = root.transpose().triangularView<Eigen::Lower>().solve(A);
  const Eigen::MatrixXd ratio = root.transpose().triangularView<Eigen::Lower>().solve(half.transpose());
  const numerics::Eigenpairs pairs_of_ratio = numerics::eigenpairs(0.5 * (ratio + ratio.transpose()));
  Eigen::MatrixXd steps = root.triangularView<Eigen::Upper>().solve(pairs_of_ratio.vectors);
  for (Eigen::Index j = 0; j < steps.cols(); ++j) {
    const double linear = 1 / std::sqrt(1 + std::max(0.0, pairs_of_ratio.values[j]));
    steps.col(j) *= std::max(narrow * linear, std::min(wide * linear, narrow));
  }
  return steps;
}

/// C⁻¹ − P of the covariance a posteriori; no direction is less certain than before the data.
Eigen::MatrixXd information_of(const Eigen::MatrixXd& C, const Eigen::MatrixXd& P) {
  const Eigen::MatrixXd root = P.llt().matrixU();
  const numerics::Eigenpairs shares = numerics::eigenpairs(root * C * root.transpose());
  const Eigen::VectorXd ratio = shares.values.cwiseMax(1e-9).cwiseInverse().array() - 1;
  const Eigen::MatrixXd back = root.transpose() * shares.vectors;
  return back * ratio.cwiseMax(0).asDiagonal() * back.transpose();
}

/// What makes the linear model of a specimen agree with its moments a posteriori; empty = nothing.
struct Correction {
  Eigen::VectorXd pull;
  Eigen::MatrixXd bend;
};

/// Points about the maximum of one specimen, with logs of their weights but for the prior's part: −(Σ_c |r_c|²/φ_c −
/// |z_s|²)/2.
struct Sample {
  Eigen::MatrixXd points, A;
  Eigen::VectorXd g;
  Eigen::ArrayXd logs;
};

Sample sample(std::size_t i, const Misfits& misfits, const Prior& prior, const Eigen::MatrixXd& u,
              const Expansion& expansion) {
  Sample result{{}, Eigen::MatrixXd::Zero(u.rows(), u.rows()), Eigen::VectorXd::Zero(u.rows()), {}};
  for (std::size_t c = 0; c < expansion.channels.size(); ++c) {
    if (expansion.channels[c].rows == 0) continue;
    result.A += expansion.channels[c].information / prior.variances[c];
    result.g += expansion.channels[c].score / prior.variances[c];
  }
  const Eigen::MatrixXd z = deviates(u, i);
  result.points = (root_of_sampling(result.A, prior.precision) * z).colwise() + expansion.point;
  result.logs =
      -0.5 * (misfits(i, result.points, prior.variances).array() - z.colwise().squaredNorm().transpose().array());
  return result;
}

/// Of the sample with a prior near that of its points.
Correction correction(const Sample& sample, const Prior& prior, const Eigen::VectorXd& point) {
  const Eigen::MatrixXd away = sample.points.colwise() - prior.mean;
  Eigen::ArrayXd logs =
      sample.logs - 0.5 * away.cwiseProduct(prior.precision * away).colwise().sum().transpose().array();
  for (Eigen::Index s = 0; s < logs.size(); ++s)
    if (!std::isfinite(logs[s])) logs[s] = -HUGE_VAL;
  const double most = logs.maxCoeff();
  if (!std::isfinite(most)) return {};
  Eigen::VectorXd weights = (logs - most).exp();
  if (weights.sum() * weights.sum() < fewest * weights.squaredNorm()) return {};
  weights /= weights.sum();
  const Eigen::VectorXd mean = sample.points * weights;
  const Eigen::MatrixXd about = sample.points.colwise() - mean;
  const Eigen::MatrixXd information = information_of(about * weights.asDiagonal() * about.transpose(), prior.precision);
  // 0 = g + u + (A + ΔA)(ξ̄ − ξ₀) + P (ξ̄ − m)
  return {-sample.g - information * (mean - point) - prior.precision * (mean - prior.mean), information - sample.A};
}

void apply(Correction correction, Expansion& expansion) {
  expansion.pull = std::move(correction.pull);
  expansion.bend = std::move(correction.bend);
}

std::vector<Prior> priors_of(const std::vector<Eigen::VectorXd>& means, const Eigen::MatrixXd& precision,
                             const Variances& variances) {
  std::vector<Prior> priors;
  for (const Eigen::VectorXd& mean : means) priors.push_back({mean, precision, variances.noise});
  return priors;
}

/// Directions S in which Ω = L (I + S) Lᵀ is not known: diagonal ones, and pairs where it is full.
std::vector<Eigen::MatrixXd> directions(Eigen::Index p, Shape shape) {
  std::vector<Eigen::MatrixXd> all;
  for (Eigen::Index j = 0; j < p; ++j)
    for (Eigen::Index k = shape == Shape::full ? 0 : j; k <= j; ++k) {
      all.emplace_back(Eigen::MatrixXd::Zero(p, p));
      all.back()(j, k) = all.back()(k, j) = 1;
    }
  return all;
}

/// Covariance of their amplitudes, the inverse of the information of the linear model: ½ Σ_i tr(Q S_k Q S_l), Q = Lᵀ
/// W_i L. One specimen has ½ at best. So much is added, because a spread of zero has none.
Eigen::MatrixXd covariance_of_variances(const std::vector<Eigen::MatrixXd>& along,
                                        const std::vector<Expansion>& expansions, const Variances& variances) {
  const auto count = static_cast<Eigen::Index>(along.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(count, count);
  for (const Marginal& m : integrate_specimens(expansions, variances)) {
    const Eigen::MatrixXd Q = variances.within.transpose() * m.W * variances.within;
    for (Eigen::Index k = 0; k < count; ++k)
      for (Eigen::Index l = 0; l < count; ++l)
        information(k, l) +=
            0.5 * (Q * along[static_cast<std::size_t>(k)] * Q * along[static_cast<std::size_t>(l)]).trace();
  }
  information.diagonal().array() += 0.5;
  return information.inverse();
}

/// Expansions about the maxima at these means; where one fails, the earlier one stays.
void expand(const Cohort& cohort, const std::vector<Prior>& priors, std::vector<Expansion>& expansions) {
  tbb::parallel_for(std::size_t{0}, expansions.size(), [&](std::size_t i) {
    auto fresh = cohort.expand(i, priors[i]);
    if (fresh && fresh->point.allFinite()) expansions[i] = std::move(*fresh);
  });
}

/// ∂β by the amplitudes of `along`, column by column: one Newton step for a Ω that is a little different, with the same
/// samples.
Eigen::MatrixXd slopes_of_means(const Cohort& cohort, const Form& form, const Variances& variances,
                                const std::vector<Eigen::MatrixXd>& along, const Eigen::MatrixXd& u,
                                const Integration& whole) {
  constexpr double h = 0.2;
  std::vector<Variances> others;
  std::vector<Eigen::MatrixXd> precisions;
  for (const Eigen::MatrixXd& S : along)
    for (const double step : {h, -h}) {
      others.push_back(variances);
      others.back().within += 0.5 * step * variances.within * S;
      precisions.push_back(prior_precision(cohort, others.back()));
    }
  std::vector<std::vector<Expansion>> expansions(others.size(), whole.expansions);
  const auto priors = priors_of(whole.means.of_specimen, prior_precision(cohort, variances), variances);
  tbb::parallel_for(std::size_t{0}, whole.expansions.size(), [&](std::size_t i) {
    const Sample own = sample(i, cohort.misfits, priors[i], u, whole.expansions[i]);
    for (std::size_t k = 0; k < others.size(); ++k)
      apply(correction(own, {priors[i].mean, precisions[k], variances.noise}, whole.expansions[i].point),
            expansions[k][i]);
  });
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(whole.means.beta.size(), static_cast<Eigen::Index>(along.size()));
  for (std::size_t k = 0; k < others.size(); k += 2) {
    const Means up = LinearModel(cohort, form.design, expansions[k], form.likelihood).means(others[k], false);
    const Means down = LinearModel(cohort, form.design, expansions[k + 1], form.likelihood).means(others[k + 1], false);
    if (up.fixed && down.fixed) slopes.col(static_cast<Eigen::Index>(k / 2)) = (up.beta - down.beta) / (2 * h);
  }
  return slopes;
}

}  // namespace

Integration integrate(const Cohort& cohort, const Form& form, const Alternation& fit) {
  Integration result{fit.expansions, fit.means};
  if (!cohort.misfits) return result;
  const Eigen::MatrixXd u = sobol(result.expansions.front().point.size());
  const Eigen::MatrixXd precision = prior_precision(cohort, fit.variances);
  const LinearModel model(cohort, form.design, result.expansions, form.likelihood);
  for (std::size_t step = 0; step < newton_steps; ++step) {
    const auto priors = priors_of(result.means.of_specimen, precision, fit.variances);
    if (step > 0) expand(cohort, priors, result.expansions);
    tbb::parallel_for(std::size_t{0}, result.expansions.size(), [&](std::size_t i) {
      Expansion& own = result.expansions[i];
      apply(correction(sample(i, cohort.misfits, priors[i], u, own), priors[i], own.point), own);
    });
    Means next = model.means(fit.variances, true);
    if (!next.fixed) return {fit.expansions, fit.means};
    result.means = std::move(next);
  }
  const auto along = directions(precision.rows(), form.within);
  const Eigen::MatrixXd slopes = slopes_of_means(cohort, form, fit.variances, along, u, result);
  result.means.covariance = fit.means.covariance +
                            slopes * covariance_of_variances(along, fit.expansions, fit.variances) * slopes.transpose();
  return result;
}

}  // namespace tunica::population
