// SPDX-License-Identifier: Apache-2.0
#include "deviator.hpp"

namespace tunica::viscoelasticity {
namespace {

/// Row and column of a component, with t = 0, z = 1, r = 2; and back.
constexpr std::array<std::array<std::size_t, 2>, 6> place{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<std::array<std::size_t, 3>, 3> component{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};

}  // namespace

double contract(const Tensor& a, const Tensor& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

Tensor inverse(const Tensor& C) {
  const auto [tt, zz, rr, tz, zr, tr] = C;
  const Tensor cofactors{zz * rr - zr * zr, tt * rr - tr * tr, tt * zz - tz * tz,
                         tr * zr - tz * rr, tz * tr - tt * zr, tz * zr - tr * zz};
  const double determinant = tt * cofactors[0] + tz * cofactors[3] + tr * cofactors[5];
  Tensor result;
  for (std::size_t c = 0; c < 6; ++c) result[c] = cofactors[c] / determinant;
  return result;
}

Tensor deviator(const Tensor& S, const Tensor& C, const Tensor& C_inverse) {
  const double third = contract(S, C) / 3;
  Tensor result;
  for (std::size_t c = 0; c < 6; ++c) result[c] = S[c] - third * C_inverse[c];
  return result;
}

Tangent deviator_tangent(const Tensor& S, const Tangent& A, const Tensor& C, const Tensor& C_inverse) {
  const double work = contract(S, C);
  Tangent result;
  for (std::size_t q = 0; q < 6; ++q) {
    Tensor column;
    for (std::size_t p = 0; p < 6; ++p) column[p] = A[6 * p + q];
    const double work_change = 2 * S[q] + contract(C, column);
    const auto [k, l] = place[q];
    for (std::size_t p = 0; p < 6; ++p) {
      const auto [i, j] = place[p];
      const auto inv = [&C_inverse](std::size_t row, std::size_t col) { return C_inverse[component[row][col]]; };
      const double inverse_change = -(inv(i, k) * inv(j, l) + inv(i, l) * inv(j, k));
      result[6 * p + q] = column[p] - (C_inverse[p] * work_change + work * inverse_change) / 3;
    }
  }
  return result;
}

}  // namespace tunica::viscoelasticity
