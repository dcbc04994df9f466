// SPDX-License-Identifier: Apache-2.0
#include "population/linear_model.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace tunica::population {
namespace {

struct Smoothed {
  Eigen::MatrixXd K;
  double log_det;
};

/// K = L (I + LᵀAL)⁻¹ Lᵀ and log det(I + LᵀAL).
Smoothed smoothed(const Eigen::MatrixXd& L, const Eigen::MatrixXd& A) {
  const Eigen::MatrixXd M = Eigen::MatrixXd::Identity(L.cols(), L.cols()) + L.transpose() * A * L;
  const Eigen::LLT<Eigen::MatrixXd> root(M);
  const Eigen::MatrixXd half = root.matrixL().solve(L.transpose());
  return {half.transpose() * half, 2 * root.matrixLLT().diagonal().array().log().sum()};
}

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& A) { return 0.5 * (A + A.transpose()); }

/// Sums of the quadratics of one animal (or of one specimen, where not nested) in its a and in β.
struct Level {
  Eigen::MatrixXd aa, ab, bb;
  Eigen::VectorXd a, b;
};

/// Adds the quadratic of a specimen about `origin` to the blocks of a and β: x xᵀ ⊗ W and x ⊗ w.
void add(Level& level, const Marginal& m, const Eigen::RowVectorXd& x, const Eigen::VectorXd& origin) {
  const Eigen::Index p = m.W.rows();
  const Eigen::VectorXd w = m.w - m.W * (m.point - origin);
  level.aa += m.W;
  level.a += w;
  for (Eigen::Index c = 0; c < x.size(); ++c) {
    if (x[c] == 0) continue;
    level.ab.middleCols(c * p, p) += x[c] * m.W;
    level.b.segment(c * p, p) += x[c] * w;
    for (Eigen::Index d = 0; d < x.size(); ++d)
      if (x[d] != 0) level.bb.block(c * p, d * p, p, p) += x[c] * x[d] * m.W;
  }
}

}  // namespace

std::vector<Marginal> integrate_specimens(const std::vector<Expansion>& expansions, const Variances& variances) {
  std::vector<Marginal> result(expansions.size());
  for (std::size_t i = 0; i < expansions.size(); ++i) {
    const Expansion& expansion = expansions[i];
    Marginal& m = result[i];
    m.point = expansion.point;
    m.A.setZero(m.point.size(), m.point.size());
    m.g.setZero(m.point.size());
    for (std::size_t c = 0; c < expansion.channels.size(); ++c) {
      const Quadratic& channel = expansion.channels[c];
      if (channel.rows == 0) continue;
      const double precision = 1 / variances.noise[c];
      m.A += precision * channel.information;
      m.g += precision * channel.score;
      m.value += precision * channel.squares + channel.rows * std::log(variances.noise[c]);
    }
    if (expansion.pull.size() > 0) {
      m.g += expansion.pull;
      m.A += expansion.bend;
    }
    const Smoothed s = smoothed(variances.within, m.A);
    m.K = s.K;
    m.T = (Eigen::MatrixXd::Identity(m.A.rows(), m.A.rows()) + m.A * variances.within * variances.within.transpose())
              .inverse();
    m.W = symmetric(m.T * m.A);
    m.w = m.T * m.g;
    m.value += s.log_det - m.g.dot(m.K * m.g);
  }
  return result;
}

Means integrate_means(const std::vector<Marginal>& marginals, const Eigen::MatrixXd& rows,
                      const std::vector<std::size_t>& animal_of, const Eigen::MatrixXd& between, Likelihood likelihood,
                      bool uncertain) {
  const Eigen::Index p = marginals.front().point.size(), q = rows.cols();
  const bool nested = !animal_of.empty();
  std::size_t levels = nested ? 0 : 1;
  for (const std::size_t k : animal_of) levels = std::max(levels, k + 1);
  const Level zero{Eigen::MatrixXd::Zero(p, p), Eigen::MatrixXd::Zero(p, p * q), Eigen::MatrixXd::Zero(p * q, p * q),
                   Eigen::VectorXd::Zero(p), Eigen::VectorXd::Zero(p * q)};
  std::vector<Level> sums(levels, zero);
  Means result;
  // Column 0 of the design is 1 throughout: coordinates about the mean expansion point keep digits.
  Eigen::VectorXd origin = Eigen::VectorXd::Zero(p);
  for (const Marginal& m : marginals) origin += m.point / static_cast<double>(marginals.size());
  for (std::size_t i = 0; i < marginals.size(); ++i) {
    const Marginal& m = marginals[i];
    add(sums[nested ? animal_of[i] : 0], m, rows.row(static_cast<Eigen::Index>(i)), origin);
    const Eigen::VectorXd away = m.point - origin;
    result.value += m.value - 2 * m.w.dot(away) + away.dot(m.W * away);
  }
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(p * q, p * q);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(p * q);
  std::vector<Eigen::MatrixXd> K;
  for (const Level& level : sums) {
    H += level.bb;
    u += level.b;
    if (!nested) continue;
    const Smoothed s = smoothed(between, level.aa);
    H -= level.ab.transpose() * s.K * level.ab;
    u -= level.ab.transpose() * (s.K * level.a);
    result.value += s.log_det - level.a.dot(s.K * level.a);
    K.push_back(s.K);
  }
  // Scaled to a unit diagonal, so that pivots tell what the data fix whatever the units.
  const Eigen::VectorXd scale = H.diagonal().cwiseMax(0).cwiseSqrt();
  if (!(scale.minCoeff() > 0) || !scale.allFinite()) {
    result.fixed = false;
    return result;
  }
  const Eigen::VectorXd shrink = scale.cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> solver(symmetric(shrink.asDiagonal() * H * shrink.asDiagonal()));
  if (solver.info() != Eigen::Success || !(solver.matrixLLT().diagonal().minCoeff() > 1e-7)) {
    result.fixed = false;
    return result;
  }
  result.covariance =
      symmetric(shrink.asDiagonal() * solver.solve(Eigen::MatrixXd::Identity(p * q, p * q)) * shrink.asDiagonal());
  result.beta = -(shrink.asDiagonal() * solver.solve(shrink.cwiseProduct(u)));
  result.value += u.dot(result.beta);
  if (likelihood == Likelihood::restricted)
    result.value += 2 * (solver.matrixLLT().diagonal().array().log().sum() + scale.array().log().sum());
  for (std::size_t k = 0; nested && k < levels; ++k)
    result.animals.push_back(-K[k] * (sums[k].a + sums[k].ab * result.beta));
  result.beta.head(p) += origin;
  for (std::size_t i = 0; i < marginals.size(); ++i) {
    const Eigen::RowVectorXd x = rows.row(static_cast<Eigen::Index>(i));
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(p);
    for (Eigen::Index c = 0; c < q; ++c) mean += x[c] * result.beta.segment(c * p, p);
    if (nested) mean += result.animals[animal_of[i]];
    result.of_specimen.push_back(mean);
    if (!uncertain) continue;
    // m_i = (X_i − K S_ab) β + …, with covariance K of a given β.
    Eigen::MatrixXd X = Eigen::MatrixXd::Zero(p, p * q);
    for (Eigen::Index c = 0; c < q; ++c) X.middleCols(c * p, p).diagonal().setConstant(x[c]);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(p, p);
    if (nested) {
      X -= K[animal_of[i]] * sums[animal_of[i]].ab;
      covariance = K[animal_of[i]];
    }
    if (likelihood == Likelihood::restricted) covariance += X * result.covariance * X.transpose();
    result.of_specimen_covariance.push_back(symmetric(covariance));
  }
  return result;
}

Posterior posterior(const Marginal& marginal, const Eigen::VectorXd& mean, const Eigen::MatrixXd& mean_covariance) {
  Posterior result;
  result.effect = -marginal.K * (marginal.g + marginal.A * (mean - marginal.point));
  result.mean = mean + result.effect;
  result.covariance = symmetric(marginal.K + marginal.T.transpose() * mean_covariance * marginal.T);
  return result;
}

LinearModel::LinearModel(const Cohort& cohort, const Design& design, const std::vector<Expansion>& expansions,
                         Likelihood likelihood)
    : expansions_(expansions), design_(design), animals_(cohort.animals.size()), likelihood_(likelihood) {
  for (std::size_t i = 0; i < cohort.specimens.size() && animals_ > 0; ++i)
    animal_of_.push_back(cohort.specimens[i].animal);
}

Means LinearModel::means(const Variances& variances, bool uncertain) const {
  return integrate_means(integrate_specimens(expansions_, variances), design_.rows, animal_of_, variances.between,
                         likelihood_, uncertain);
}

double LinearModel::value(const Variances& variances, VarianceGradient* gradient) const {
  const auto marginals = integrate_specimens(expansions_, variances);
  const Means means =
      integrate_means(marginals, design_.rows, animal_of_, variances.between, likelihood_, gradient != nullptr);
  if (!means.fixed) return std::numeric_limits<double>::infinity();
  if (gradient == nullptr) return means.value;
  const Eigen::Index p = marginals.front().point.size();
  gradient->within.setZero(p, p);
  gradient->between.setZero(p, p);
  gradient->noise.setZero(static_cast<Eigen::Index>(variances.noise.size()));
  std::vector<Eigen::VectorXd> pulls(animals_, Eigen::VectorXd::Zero(p));
  std::vector<Eigen::MatrixXd> informations(animals_, Eigen::MatrixXd::Zero(p, p));
  std::vector<Eigen::MatrixXd> slopes(animals_, Eigen::MatrixXd::Zero(p, design_.rows.cols() * p));
  for (std::size_t i = 0; i < marginals.size(); ++i) {
    const Marginal& m = marginals[i];
    const Eigen::VectorXd& mean = means.of_specimen[i];
    const Eigen::MatrixXd& C = means.of_specimen_covariance[i];
    const Eigen::VectorXd v = m.w + m.W * (mean - m.point);
    gradient->within += m.W - v * v.transpose() - m.W * C * m.W;
    const Posterior own = posterior(m, mean, C);
    const Eigen::VectorXd step = own.mean - m.point;
    for (std::size_t c = 0; c < variances.noise.size(); ++c) {
      const Quadratic& channel = expansions_[i].channels[c];
      if (channel.rows == 0) continue;
      const double squares = channel.squares + 2 * channel.score.dot(step) + step.dot(channel.information * step) +
                             channel.information.cwiseProduct(own.covariance).sum();
      gradient->noise[static_cast<Eigen::Index>(c)] += channel.rows - squares / variances.noise[c];
    }
    if (animal_of_.empty()) continue;
    const std::size_t k = animal_of_[i];
    pulls[k] += v;
    informations[k] += m.W;
    const Eigen::RowVectorXd x = design_.rows.row(static_cast<Eigen::Index>(i));
    for (Eigen::Index d = 0; d < x.size(); ++d) slopes[k].middleCols(d * p, p) += x[d] * m.W;
  }
  for (std::size_t k = 0; k < animals_; ++k) {
    // Σ v at m = X β + a is (I − S K)(…) at a = 0: the pull of the level above.
    const Eigen::MatrixXd& S = informations[k];
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(p, p) - S * smoothed(variances.between, S).K;
    gradient->between += symmetric(rest * S) - pulls[k] * pulls[k].transpose();
    if (likelihood_ == Likelihood::restricted) {
      const Eigen::MatrixXd slope = rest * slopes[k];
      gradient->between -= slope * means.covariance * slope.transpose();
    }
  }
  return means.value;
}

}  // namespace tunica::population
