// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/detection/noise_draws.hpp"

#include <algorithm>
#include <cmath>

#include <boost/random/gamma_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "tunica/random.hpp"

namespace tunica::diagnosis {

Eigen::MatrixXf noise_draws(const std::vector<Curve>& curves, Eigen::Index rows, std::size_t draws,
                            std::uint64_t seed) {
  boost::random::mt19937_64 generator(derive_seed(seed, "noise draws"));
  boost::random::normal_distribution<double> normal;
  Eigen::MatrixXf all(rows, static_cast<Eigen::Index>(draws));
  for (Eigen::Index b = 0; b < all.cols(); ++b)
    for (Eigen::Index i = 0; i < rows; ++i) all(i, b) = static_cast<float>(normal(generator));
  // A correlation that was estimated a little wrong leaves some of it in the whitened rows of all curves alike.
  std::vector<double> left(draws);
  for (double& value : left) value = normal(generator);
  for (const Curve& curve : curves) {
    if (!(curve.noise.freedom > 0)) continue;
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
  return all;
}

}  // namespace tunica::diagnosis
