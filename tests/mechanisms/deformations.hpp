// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace tunica::testing {

using Tensor = std::array<double, 6>;  // tt, zz, rr, tz, zr, tr

/// C = FᵀF for n deformation gradients 1 + 0.3 R, entries of R uniform in [−1, 1]; structure of arrays. det F is
/// above 0.1 for every draw that is kept.
inline std::vector<double> random_deformations(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  std::vector<double> C(6 * n);
  for (std::size_t i = 0; i < n;) {
    double F[3][3];
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) F[a][b] = (a == b ? 1 : 0) + uniform(generator);
    }
    const double J = F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) -
                     F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
                     F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
    if (J < 0.1) continue;
    const auto product = [&F](std::size_t a, std::size_t b) {
      return F[0][a] * F[0][b] + F[1][a] * F[1][b] + F[2][a] * F[2][b];
    };
    const Tensor c{product(0, 0), product(1, 1), product(2, 2), product(0, 1), product(1, 2), product(2, 0)};
    for (std::size_t k = 0; k < 6; ++k) C[k * n + i] = c[k];
    ++i;
  }
  return C;
}

/// diag(λ², 1/λ, 1/λ): a strip along t of an isotropic material.
inline std::vector<double> uniaxial_deformation(double stretch) {
  return {stretch * stretch, 1 / stretch, 1 / stretch, 0, 0, 0};
}

/// The largest |a_i − b_i| over the largest |b_i|.
inline double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = a.size() == b.size() ? 0 : INFINITY, size = 0;
  for (std::size_t i = 0; i < b.size() && i < a.size(); ++i) {
    difference = std::fmax(difference, std::abs(a[i] - b[i]));
    if (std::isnan(a[i]) || std::isnan(b[i])) difference = INFINITY;
    size = std::fmax(size, std::abs(b[i]));
  }
  return size > 0 ? difference / size : difference;
}

}  // namespace tunica::testing
