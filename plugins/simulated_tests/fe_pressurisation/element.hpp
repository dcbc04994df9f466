// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace tunica::fe {

/// Shape functions, Gauss rule and pressure modes of a rectangle on ξ, η ∈ [−1, 1]; ξ runs along R, η along Z. Node a
/// stands at (a mod m, a div m) of an m × m grid.
///
/// Pairs of displacement and pressure, pressures discontinuous between elements:
///   quadrilateral_4  bilinear, constant pressure (Q1/P0): the classical element of incompressible elasticity; of
///                    first order in pressure and with a mild checkerboard, its displacements converge as h²;
///   quadrilateral_9  biquadratic, linear pressure (Q2/P−1): inf–sup stable, displacements converge as h³.
/// Source: D. Boffi, F. Brezzi, M. Fortin, Mixed Finite Element Methods and Applications, Springer (2013), section 8.6.
template <std::size_t Order>
struct Element {
  static constexpr std::size_t order = Order;
  static constexpr std::size_t side = Order + 1;       ///< nodes along an edge
  static constexpr std::size_t nodes = side * side;    ///< of an element
  static constexpr std::size_t points_1d = Order + 1;  ///< Gauss points along an edge
  static constexpr std::size_t points = points_1d * points_1d;
  static constexpr std::size_t modes = Order == 1 ? 1 : 3;  ///< pressure modes 1, ξ, η

  std::array<double, points_1d> abscissa{}, weight_1d{};
  std::array<std::array<double, side>, points_1d> shape_1d{}, slope_1d{};  ///< of the edge, by its coordinate
  std::array<double, points> xi{}, eta{}, weight{};
  std::array<std::array<double, nodes>, points> shape{}, by_xi{}, by_eta{};
  std::array<std::array<double, modes>, points> mode{};

  Element() {
    if constexpr (Order == 1) {
      abscissa = {-1 / std::sqrt(3.), 1 / std::sqrt(3.)};
      weight_1d = {1, 1};
    } else {
      abscissa = {-std::sqrt(0.6), 0, std::sqrt(0.6)};
      weight_1d = {5. / 9, 8. / 9, 5. / 9};
    }
    for (std::size_t g = 0; g < points_1d; ++g) {
      const double x = abscissa[g];
      if constexpr (Order == 1) {
        shape_1d[g] = {(1 - x) / 2, (1 + x) / 2};
        slope_1d[g] = {-0.5, 0.5};
      } else {
        shape_1d[g] = {x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2};
        slope_1d[g] = {x - 0.5, -2 * x, x + 0.5};
      }
    }
    for (std::size_t g = 0; g < points; ++g) {
      const std::size_t i = g % points_1d, k = g / points_1d;
      xi[g] = abscissa[i];
      eta[g] = abscissa[k];
      weight[g] = weight_1d[i] * weight_1d[k];
      for (std::size_t a = 0; a < nodes; ++a) {
        shape[g][a] = shape_1d[i][a % side] * shape_1d[k][a / side];
        by_xi[g][a] = slope_1d[i][a % side] * shape_1d[k][a / side];
        by_eta[g][a] = shape_1d[i][a % side] * slope_1d[k][a / side];
      }
      mode[g][0] = 1;
      if constexpr (modes == 3) {
        mode[g][1] = xi[g];
        mode[g][2] = eta[g];
      }
    }
  }
};

}  // namespace tunica::fe
