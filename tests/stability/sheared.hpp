// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace tunica::stability {

/// C of (1 + ε m⊗n) F, F diagonal.
inline std::array<double, 6> sheared(const std::array<double, 3>& stretch, const std::array<double, 3>& m,
                                     const std::array<double, 3>& n, double epsilon) {
  double F[3][3];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) F[i][j] = ((i == j) + epsilon * m[i] * n[j]) * stretch[j];
  const auto C = [&](std::size_t a, std::size_t b) {
    return F[0][a] * F[0][b] + F[1][a] * F[1][b] + F[2][a] * F[2][b];
  };
  return {C(0, 0), C(1, 1), C(2, 2), C(0, 1), C(1, 2), C(2, 0)};
}

}  // namespace tunica::stability
