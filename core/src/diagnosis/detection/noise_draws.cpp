// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/detection/noise_draws.hpp"

#include <algorithm>
#include <cmath>

#include <boost/random/discrete_distribution.hpp>
#include <boost/random/gamma_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "assembly/restricted_variance.hpp"
#include "diagnosis/evidence/moderation.hpp"
#include "tunica/random.hpp"

namespace tunica::diagnosis {

namespace {

/// The moderation among the channels of one draw, from Σ e² of each.
Moderation moderation_in(const Eigen::VectorXf& squares, const Eigen::VectorXf& freedom) {
  std::vector<double> ratios, own;
  for (Eigen::Index g = 0; g < squares.size(); ++g) {
    if (!(freedom[g] > least_freedom) || !(squares[g] > 0)) continue;
    ratios.push_back(static_cast<double>(squares[g] / freedom[g]));
    own.push_back(static_cast<double>(freedom[g]));
  }
  return moderation_of(ratios, own);
}

/// Rows of each draw with one of the ways in which their noise may grow with the level.
void grow_otherwise(const EstimatedNoise& estimated, boost::random::mt19937_64& generator, Eigen::MatrixXf& draws) {
  if (estimated.probability.empty()) return;
  boost::random::discrete_distribution<Eigen::Index> way(estimated.probability.begin(), estimated.probability.end());
  const Eigen::MatrixXf sd = estimated.variance.cast<float>().cwiseSqrt();
  for (auto draw : draws.colwise()) draw.array() *= sd.col(way(generator)).array();
}

/// Each draw by the σ that the estimate would have found in it.
void estimate_anew(const EstimatedNoise& estimated, boost::random::mt19937_64& generator, Draws& all) {
  if (estimated.span.cols() == 0) return;
  Eigen::MatrixXf& draws = all.residuals;
  const Eigen::MatrixXf Q = estimated.span.cast<float>();
  std::size_t groups = 0;
  for (const std::size_t g : estimated.group)
    if (g != assembly::known_variance) groups = std::max(groups, g + 1);
  const auto count = static_cast<Eigen::Index>(groups);
  Eigen::VectorXf freedom = Eigen::VectorXf::Zero(count);
  Eigen::MatrixXf squares = Eigen::MatrixXf::Zero(count, draws.cols());
  const auto group_of = [&](Eigen::Index i) { return estimated.group[static_cast<std::size_t>(i)]; };
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    if (group_of(i) == assembly::known_variance) continue;
    const auto g = static_cast<Eigen::Index>(group_of(i));
    freedom[g] += std::max(0.0F, 1 - Q.row(i).squaredNorm());
  }
  constexpr Eigen::Index at_once = 500;  // draws
  for (Eigen::Index first = 0; first < draws.cols(); first += at_once) {
    const auto some = draws.middleCols(first, std::min(at_once, draws.cols() - first));
    const Eigen::MatrixXf left = some - Q * (Q.transpose() * some);
    for (Eigen::Index i = 0; i < left.rows(); ++i)
      if (group_of(i) != assembly::known_variance)
        squares.row(static_cast<Eigen::Index>(group_of(i))).segment(first, left.cols()) += left.row(i).cwiseAbs2();
  }
  const auto d = static_cast<float>(estimated.moderation);
  boost::random::gamma_distribution<float> gamma(std::max(d / 2, 1e-3F), 2 / std::max(d, 1e-3F));  // χ²_d/d
  Eigen::VectorXf true_variance = Eigen::VectorXf::Ones(count);
  for (Eigen::Index b = 0; b < draws.cols(); ++b) {
    if (d > 0)
      for (float& variance : true_variance) variance = 1 / std::max(gamma(generator), 1e-6F);
    const Moderation others = d > 0 ? moderation_in(true_variance.cwiseProduct(squares.col(b)), freedom) : Moderation{};
    const auto of_others = static_cast<float>(others.freedom);
    for (Eigen::Index g = 0; g < count; ++g) {
      const float found = (of_others * static_cast<float>(others.ratio) + true_variance[g] * squares(g, b)) /
                          std::max(of_others + freedom[g], 1e-6F);
      squares(g, b) = true_variance[g] / std::max(found, 1e-6F * true_variance[g]);
    }
  }
  for (Eigen::Index i = 0; i < draws.rows(); ++i)
    if (group_of(i) != assembly::known_variance)
      draws.row(i).array() *= squares.row(static_cast<Eigen::Index>(group_of(i))).array().sqrt();
  all.precision = std::move(squares);
  all.group = estimated.group;
}

}  // namespace

Eigen::VectorXd Draws::precision_of_rows(Eigen::Index draw) const {
  if (precision.rows() == 0) return {};
  Eigen::VectorXd rows = Eigen::VectorXd::Ones(residuals.rows());
  for (std::size_t i = 0; i < group.size(); ++i)
    if (group[i] != assembly::known_variance)
      rows[static_cast<Eigen::Index>(i)] = static_cast<double>(precision(static_cast<Eigen::Index>(group[i]), draw));
  return rows;
}

Draws noise_draws(const Evidence& evidence, std::size_t draws, std::uint64_t seed) {
  const Eigen::Index rows = evidence.fit.residuals.size();
  boost::random::mt19937_64 generator(derive_seed(seed, "noise draws"));
  boost::random::normal_distribution<double> normal;
  Draws found;
  Eigen::MatrixXf& all = found.residuals;
  all.resize(rows, static_cast<Eigen::Index>(draws));
  for (Eigen::Index b = 0; b < all.cols(); ++b)
    for (Eigen::Index i = 0; i < rows; ++i) all(i, b) = static_cast<float>(normal(generator));
  // An error in the estimated correlation leaves some correlation in the whitened rows of all curves.
  std::vector<double> left(draws);
  for (double& value : left) value = normal(generator);
  for (const Curve& curve : evidence.curves) {
    if (!(curve.noise.freedom > 0) || curve.noise.kind == NoiseSource::Kind::encompassing) continue;
    // σ̂²/σ² ~ χ²_ν/ν
    boost::random::gamma_distribution<double> gamma(curve.noise.freedom / 2, 2 / curve.noise.freedom);
    for (Eigen::Index b = 0; b < all.cols(); ++b) {
      auto rows_of = all.col(b).segment(curve.first, curve.count);
      if (curve.noise.correlation_sd > 0) {
        const double rest = curve.noise.correlation_sd * left[static_cast<std::size_t>(b)];
        float before = 0;
        for (float& value : rows_of) before = value = value + static_cast<float>(rest) * before;
      }
      rows_of /= static_cast<float>(std::sqrt(std::max(gamma(generator), 1e-6)));
    }
  }
  grow_otherwise(evidence.estimated, generator, all);
  estimate_anew(evidence.estimated, generator, found);
  return found;
}

}  // namespace tunica::diagnosis
