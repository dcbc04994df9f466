// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "maxwell_path.hpp"
#include "relaxation.hpp"
#include "tunica/detail/lanes.hpp"

/// What MaxwellPath has of one block of rows, and where the next one begins.
namespace tunica::uniaxial::maxwell {

constexpr std::size_t block = MaxwellPath::block, most = MaxwellPath::most_branches;
using Column = std::array<double, block>;
using Axes = std::array<Column, 3>;  ///< 0 the loaded one, 1 transverse, 2 normal

/// What one branch carries, as if its stiffness were 1.
struct Branch {
  Relaxation relaxation;
  double g = 0;
  std::array<double, 3> h_before, t_before;  ///< h; ∂h/∂τ, at the end of the rows before
  std::array<double, 3> h_after, t_after;    ///< and of the block
  Axes h, t;                                 ///< h; g ∂h/∂τ
  Axes again;  ///< what a step in y one row ago adds to h now: (e^{−x} φ_before − φ) dg'/dy of the row before
};

/// BlockScratch of one thread. Columns of the model have the rows of the block as their stride.
struct BlockScratch {
  std::array<double, 3 * block> c, gradient;
  std::array<double, 6 * block> hessian;
  std::vector<double> gradient_dp;
  Axes slope, dev, dev_slope, all;                          ///< dg/dy; g'; dg'/dy; g with all h
  Column residual, by_y, by_residual, stress, stress_by_y;  ///< r, dr/dy, dy/dr, σ11, ∂σ11/∂y
  Column still_stress, past_stress;                         ///< σ11 without steps; what earlier ones add
  Column y_again, stress_again;                             ///< what y of the row before does to y and σ11 at once
  Column start, step, before, nothing{};                    ///< y of the elastic strip; of Newton, and the one before
  std::array<double, 3> dev_before, dev_after;              ///< g' of the row before the block, and of its last one
  std::array<double, 4> seen;  ///< y beside start in rows at equal distances, the last first
  std::array<Branch, most> branches;
  std::vector<double> memory_dp, dev_dp_before;  ///< derivatives of h and of g' at the row before, [·][parameter]
};
inline BlockScratch& thread_block() {
  thread_local BlockScratch instance;
  return instance;
}

inline void make_room(std::vector<double>& column, std::size_t n) {
  if (column.size() < n) column.resize(n);
}

/// Newton's backward differences up to an order, over k!; 0 beyond it.
inline std::array<double, 4> differences(std::array<double, 4> seen, std::size_t order) {
  std::array<double, 4> found{seen[0]};
  double factorial = 1;
  for (std::size_t k = 1; k <= order; ++k) {
    for (std::size_t j = 0; j + k < seen.size(); ++j) seen[j] -= seen[j + 1];
    factorial *= static_cast<double>(k);
    found[k] = seen[0] / factorial;
  }
  return found;
}
/// The polynomial through the last shifts, so many distances beyond the last row.
inline double continued(const std::array<double, 4>& by, double ahead) {
  return by[0] + ahead * (by[1] + (ahead + 1) * (by[2] + (ahead + 2) * by[3]));
}

/// One row of columns.
template <std::size_t width>
[[gnu::always_inline]] inline detail::Lanes<width> gathered(const std::array<const double*, width>& columns,
                                                            std::size_t row) {
  double lanes[width];
  for (std::size_t l = 0; l < width; ++l) lanes[l] = columns[l][row];
  return detail::Lanes<width>::load(lanes);
}

constexpr std::size_t distance = block / 4;

}  // namespace tunica::uniaxial::maxwell
