// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "membrane.hpp"

namespace tunica::plane {

using Vector = std::array<double, 2>;  ///< x, y

/// In-plane deformation gradient xx, xy, yx, yy: F_iJ = δ_iJ + Σ u_i ∂N/∂X_J.
using Gradient = std::array<double, 4>;

/// Isoparametric elements of one kind, N nodes and Q Gauss points each: strains, forces and stiffness of a sheet of
/// unit thickness. The displacement of node a: u_x at 2a, u_y at 2a + 1, mm.
template <std::size_t N, std::size_t Q>
struct Elements {
  static constexpr std::size_t dofs = 2 * N, entries = dofs * (dofs + 1) / 2;
  static constexpr std::uint32_t nowhere = 0xffffffff;
  struct Gauss {
    std::array<double, N> x, y;  ///< ∂N/∂X, ∂N/∂Y
    double weight;               ///< with det J
  };
  std::vector<std::array<std::size_t, N>> nodes;
  std::vector<Gauss> gauss;                                  ///< Q an element
  std::vector<std::array<std::uint32_t, entries>> places{};  ///< of each lower triangle in the pattern

  [[nodiscard]] std::size_t points() const { return gauss.size(); }
  [[nodiscard]] std::size_t dof(std::size_t e, std::size_t k) const { return 2 * nodes[e][k / 2] + k % 2; }

  /// F, and C̄ for the membrane, at every Gauss point.
  void strain(std::span<const double> u, std::vector<Gradient>& F, Membrane& membrane) const {
    const std::size_t n = points();
    F.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      auto [xx, xy, yx, yy] = slope(i, u);
      xx += 1;
      yy += 1;
      F[i] = {xx, xy, yx, yy};
      membrane.C[i] = xx * xx + yx * yx;
      membrane.C[n + i] = xy * xy + yy * yy;
      membrane.C[2 * n + i] = xx * xy + yx * yy;
    }
  }

  /// Adds f_int = Σ w Bᵀ S of the membrane's stress, or of one of its derivatives by parameters: 3n entries.
  void add_forces(const std::vector<Gradient>& F, std::span<const double> stress, std::vector<double>& f) const {
    const std::size_t n = points();
    for (std::size_t i = 0; i < n; ++i) {
      const auto [xx, xy, yx, yy] = F[i];
      const double weight = gauss[i].weight;
      const double S0 = weight * stress[i], S1 = weight * stress[n + i], S2 = weight * stress[2 * n + i];
      // P = F S
      scatter(i, {xx * S0 + xy * S2, xx * S2 + xy * S1, yx * S0 + yy * S2, yx * S2 + yy * S1}, f);
    }
  }

  /// Adds ∂f_int/∂u v of a change v of all displacements: from δP = δF S + F δS.
  void add_force_change(const std::vector<Gradient>& F, const Membrane& membrane, std::span<const double> v,
                        std::vector<double>& f) const {
    const std::size_t n = points();
    for (std::size_t i = 0; i < n; ++i) {
      const Gauss& g = gauss[i];
      const auto [xx, xy, yx, yy] = F[i];
      const auto [dxx, dxy, dyx, dyy] = slope(i, v);  // δF
      // B v = (FᵀδF)_xx, (FᵀδF)_yy, (FᵀδF)_xy + (FᵀδF)_yx
      const std::array<double, 3> strain{xx * dxx + yx * dyx, xy * dxy + yy * dyy,
                                         xx * dxy + yx * dyy + xy * dxx + yy * dyx};
      std::array<double, 3> dS{}, S{};
      for (std::size_t a = 0; a < 3; ++a) {
        S[a] = g.weight * membrane.stress[a * n + i];
        for (std::size_t b = 0; b < 3; ++b) dS[a] += g.weight * membrane.tangent[(3 * a + b) * n + i] * strain[b];
      }
      // δP = δF S + F δS
      scatter(i,
              {dxx * S[0] + dxy * S[2] + xx * dS[0] + xy * dS[2], dxx * S[2] + dxy * S[1] + xx * dS[2] + xy * dS[1],
               dyx * S[0] + dyy * S[2] + yx * dS[0] + yy * dS[2], dyx * S[2] + dyy * S[1] + yx * dS[2] + yy * dS[1]},
              f);
    }
  }

  /// Lower triangle of the stiffness over the unknowns, with `places`. `unknown` is by dof, `none` where prescribed.
  Eigen::SparseMatrix<double> pattern(const std::vector<std::size_t>& unknown, std::size_t none, std::size_t size) {
    std::vector<Eigen::Triplet<double>> found;
    const auto each = [&](auto visit) {
      for (std::size_t e = 0; e < nodes.size(); ++e) {
        std::size_t at = 0;
        for (std::size_t k = 0; k < dofs; ++k)
          for (std::size_t l = 0; l <= k; ++l, ++at) {
            const std::size_t i = unknown[dof(e, k)], j = unknown[dof(e, l)];
            if (i != none && j != none)
              visit(e, at, static_cast<int>(std::max(i, j)), static_cast<int>(std::min(i, j)));
          }
      }
    };
    each([&](std::size_t, std::size_t, int i, int j) { found.emplace_back(i, j, 1.0); });
    Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));
    matrix.setFromTriplets(found.begin(), found.end());
    matrix.makeCompressed();
    places.assign(nodes.size(), {});
    for (auto& of_element : places) of_element.fill(nowhere);
    each([&](std::size_t e, std::size_t at, int i, int j) {
      places[e][at] = static_cast<std::uint32_t>(&matrix.coeffRef(i, j) - matrix.valuePtr());
    });
    return matrix;
  }

  /// The stiffness over the unknowns, and its columns times a direction of all dofs: ∂f/∂direction.
  void stiffness(const std::vector<Gradient>& F, const Membrane& membrane, const std::vector<double>& direction,
                 Eigen::SparseMatrix<double>& K, std::vector<double>& by_direction) const {
    double* const values = K.valuePtr();
    std::fill(values, values + K.nonZeros(), 0.0);
    by_direction.assign(direction.size(), 0);
    Eigen::Matrix<double, dofs, dofs> element_K;
    for (std::size_t e = 0; e < nodes.size(); ++e) {
      element_K.setZero();
      for (std::size_t i = Q * e; i < Q * (e + 1); ++i) add_point(i, F[i], membrane, element_K);
      std::size_t at = 0;
      for (std::size_t k = 0; k < dofs; ++k) {
        const std::size_t row = dof(e, k);
        for (std::size_t l = 0; l <= k; ++l, ++at) {
          const double value = element_K(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l));
          if (places[e][at] != nowhere) values[places[e][at]] += value;
          const std::size_t column = dof(e, l);
          by_direction[row] += value * direction[column];
          if (l != k) by_direction[column] += value * direction[row];
        }
      }
    }
  }

 private:
  /// Σ u ∂N/∂X at a Gauss point: xx, xy, yx, yy.
  [[nodiscard]] Gradient slope(std::size_t i, std::span<const double> u) const {
    const auto& element = nodes[i / Q];
    const Gauss& g = gauss[i];
    Gradient sum{};
    for (std::size_t a = 0; a < N; ++a) {
      const double ux = u[2 * element[a]], uy = u[2 * element[a] + 1];
      sum[0] += ux * g.x[a];
      sum[1] += ux * g.y[a];
      sum[2] += uy * g.x[a];
      sum[3] += uy * g.y[a];
    }
    return sum;
  }

  /// f += P ∂N/∂X of a Gauss point, P with its weight: xx, xy, yx, yy.
  void scatter(std::size_t i, const Gradient& P, std::vector<double>& f) const {
    const auto& element = nodes[i / Q];
    const Gauss& g = gauss[i];
    for (std::size_t a = 0; a < N; ++a) {
      f[2 * element[a]] += P[0] * g.x[a] + P[1] * g.y[a];
      f[2 * element[a] + 1] += P[2] * g.x[a] + P[3] * g.y[a];
    }
  }

  /// K += w (Bᵀ D B + geometric part), D = 2 ∂S̄/∂C̄.
  void add_point(std::size_t i, const Gradient& F, const Membrane& membrane,
                 Eigen::Matrix<double, dofs, dofs>& K) const {
    const std::size_t n = points();
    const Gauss& g = gauss[i];
    const auto [xx, xy, yx, yy] = F;
    Eigen::Matrix<double, 3, dofs> B;
    for (std::size_t a = 0; a < N; ++a) {
      const auto c = static_cast<Eigen::Index>(2 * a);
      const double x = g.x[a], y = g.y[a];
      B(0, c) = xx * x;
      B(0, c + 1) = yx * x;
      B(1, c) = xy * y;
      B(1, c + 1) = yy * y;
      B(2, c) = xx * y + xy * x;
      B(2, c + 1) = yx * y + yy * x;
    }
    Eigen::Matrix3d D;
    for (Eigen::Index a = 0; a < 3; ++a)
      for (Eigen::Index b = 0; b < 3; ++b)
        D(a, b) = g.weight * membrane.tangent[static_cast<std::size_t>(3 * a + b) * n + i];
    K.noalias() += B.transpose() * (D * B);
    const double S0 = g.weight * membrane.stress[i], S1 = g.weight * membrane.stress[n + i],
                 S2 = g.weight * membrane.stress[2 * n + i];
    for (std::size_t a = 0; a < N; ++a) {
      const double x = S0 * g.x[a] + S2 * g.y[a], y = S2 * g.x[a] + S1 * g.y[a];
      for (std::size_t b = 0; b <= a; ++b) {
        const double geometric = x * g.x[b] + y * g.y[b];
        const auto r = static_cast<Eigen::Index>(2 * a), c = static_cast<Eigen::Index>(2 * b);
        K(r, c) += geometric;
        K(r + 1, c + 1) += geometric;
      }
    }
  }
};

}  // namespace tunica::plane
