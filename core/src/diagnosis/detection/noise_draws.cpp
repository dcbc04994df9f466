// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/detection/noise_draws.hpp"

#include <algorithm>
#include <cmath>

#include <boost/random/gamma_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "assembly/restricted_variance.hpp"
#include "tunica/random.hpp"

namespace tunica::diagnosis {

namespace {

/// Each draw by the σ that the estimate would have found in it.
void estimate_anew(const EstimatedNoise& estimated, boost::random::mt19937_64& generator, Eigen::MatrixXf& draws) {
  if (estimated.span.cols() == 0) return;
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
  for (Eigen::Index g = 0; g < count; ++g)
    for (Eigen::Index b = 0; b < draws.cols(); ++b) {
      const float true_variance = d > 0 ? 1 / std::max(gamma(generator), 1e-6F) : 1;
      const float found = (d + true_variance * squares(g, b)) / std::max(d + freedom[g], 1e-6F);
      squares(g, b) = std::sqrt(std::max(found / true_variance, 1e-6F));
    }
  for (Eigen::Index i = 0; i < draws.rows(); ++i)
    if (group_of(i) != assembly::known_variance)
      draws.row(i).array() /= squares.row(static_cast<Eigen::Index>(group_of(i))).array();
}

}  // namespace

Eigen::MatrixXf noise_draws(const Evidence& evidence, std::size_t draws, std::uint64_t seed) {
  const Eigen::Index rows = evidence.fit.residuals.size();
  boost::random::mt19937_64 generator(derive_seed(seed, "noise draws"));
  boost::random::normal_distribution<double> normal;
  Eigen::MatrixXf all(rows, static_cast<Eigen::Index>(draws));
  for (Eigen::Index b = 0; b < all.cols(); ++b)
    for (Eigen::Index i = 0; i < rows; ++i) all(i, b) = static_cast<float>(normal(generator));
  // A correlation that was estimated a little wrong leaves some of it in the whitened rows of all curves alike.
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
  estimate_anew(evidence.estimated, generator, all);
  return all;
}

}  // namespace tunica::diagnosis
