// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "tunica/detail/free_faces.hpp"
#include "tunica/model.hpp"
#include "tunica/models/autodiff.hpp"

/// Tensors for PrincipalStretches.
namespace tunica::principal_stretches {

using Tensor = free_faces::Tensor;            ///< tt, zz, rr, tz, zr, tr
using Vector = free_faces::VectorOf<double>;  ///< t, z, r
using free_faces::dyad;

/// C = Σ_a c_a n_a ⊗ n_a; not-a-number throughout where C is no finite tensor.
struct Spectrum {
  std::array<double, 3> c;  ///< squared stretches, rising
  std::array<Vector, 3> n;  ///< unit vectors of their directions

  /// By the iterative solver: the closed form loses half the digits where stretches are close.
  explicit Spectrum(const Tensor& C) {
    Eigen::Matrix3d matrix;
    matrix << C[0], C[3], C[5], C[3], C[1], C[4], C[5], C[4], C[2];
    if (!matrix.allFinite()) {
      c.fill(std::numeric_limits<double>::quiet_NaN());
      n.fill({c[0], c[0], c[0]});
      return;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
    for (int a = 0; a < 3; ++a) {
      c[a] = solver.eigenvalues()[a];
      for (int i = 0; i < 3; ++i) n[a][i] = solver.eigenvectors()(i, a);
    }
  }
};

}  // namespace tunica::principal_stretches

namespace tunica {

/// A model whose energy is a sum over the principal stretches, W(C; p) = Σ_a w(λ_a; p) (Valanis, Landel 1967).
///
/// A plugin is a parameter table and one law (laws.hpp) with x = λ:
///
///     PrincipalStretches<laws::Ogden<3>>(description)
///
/// Mathematics: with f(c) = w'(λ)/(2λ), c = λ², the stress S = 2 f(C) is an isotropic function of C, so that in
/// principal axes S_aa = 2 f(c_a) and, for coaxial and turning increments alike,
///
///     2 ∂S/∂C = 4 Σ_ab f[c_a, c_b] sym(n_a⊗n_b) ⊗ sym(n_a⊗n_b)
///
/// with the divided difference f[x, y] = (f(y) − f(x))/(y − x), f[x, x] = f'(x) (Daletskii, Krein 1951; Ogden 1984,
/// Non-Linear Elastic Deformations, §6.1.4). Where two stretches come together, the quotient would cancel. There f[x,
/// y] is the mean of f' between them, which is the same number.
///
/// Threads and failure: as Model. Mechanisms cannot change this energy, because it has no parts.
template <class Law>
class PrincipalStretches : public Model {
 public:
  /// Sets `description.principal_axes`. The parameters are those of the law, in its order.
  explicit PrincipalStretches(ModelDescription description) : description_(std::move(description)) {
    description_.principal_axes = true;
    description_.energy_derivatives = true;
  }

  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate_axes(const AxisPoints& points, const AxisResponse& out) const override {
    const std::size_t n = points.count;
    for (std::size_t begin = 0; begin < n; begin += chunk) {
      const std::size_t m = n - begin < chunk ? n - begin : chunk;
      Stretches s;
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t i = 0; i < m; ++i) s.lambda[a * m + i] = std::sqrt(points.c[a * n + begin + i]);
      s.respond(points.parameters, 3 * m, !out.energy.empty(), !out.hessian.empty(), !out.gradient_dp.empty(),
                !out.energy_dp.empty());
      for (std::size_t i = 0; !out.energy.empty() && i < m; ++i)
        out.energy[begin + i] = s.value[i] + s.value[m + i] + s.value[2 * m + i];
      for (std::size_t j = 0; !out.energy_dp.empty() && j < parameter_count; ++j)
        for (std::size_t i = 0; i < m; ++i) {
          const double* const by_p = &s.value_dp[3 * j * m + i];
          out.energy_dp[j * n + begin + i] = by_p[0] + by_p[m] + by_p[2 * m];
        }
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t i = 0; i < m; ++i) {
          const std::size_t k = a * m + i, place = a * n + begin + i;
          if (!out.gradient.empty()) out.gradient[place] = s.f(k);
          if (!out.hessian.empty()) {
            out.hessian[place] = s.f_prime(k);
            out.hessian[place + 3 * n] = 0;
          }
          for (std::size_t j = 0; !out.gradient_dp.empty() && j < parameter_count; ++j)
            out.gradient_dp[3 * j * n + place] = s.f_dp(j, k, 3 * m);
        }
    }
    return {};
  }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const std::size_t n = points.count;
    for (std::size_t i = 0; i < n; ++i) {
      Tensor C;
      for (std::size_t k = 0; k < 6; ++k) C[k] = points.C[k * n + i];
      const principal_stretches::Spectrum at(C);
      Stretches s;
      for (std::size_t a = 0; a < 3; ++a) s.lambda[a] = std::sqrt(at.c[a]);
      s.respond(points.parameters, 3, !out.energy.empty(), !out.tangent.empty(), !out.stress_dp.empty());
      if (!out.energy.empty()) out.energy[i] = s.value[0] + s.value[1] + s.value[2];
      std::array<Tensor, 3> axes;
      for (std::size_t a = 0; a < 3; ++a) axes[a] = principal_stretches::dyad(at.n[a], at.n[a]);
      for (std::size_t k = 0; k < 6; ++k) {
        const auto on_axes = [&axes, k](double x, double y, double z) {
          return 2 * (x * axes[0][k] + y * axes[1][k] + z * axes[2][k]);
        };
        if (!out.stress.empty()) out.stress[k * n + i] = on_axes(s.f(0), s.f(1), s.f(2));
        for (std::size_t j = 0; !out.stress_dp.empty() && j < parameter_count; ++j)
          out.stress_dp[(6 * j + k) * n + i] = on_axes(s.f_dp(j, 0, 3), s.f_dp(j, 1, 3), s.f_dp(j, 2, 3));
      }
      if (!out.tangent.empty()) set_tangent(points.parameters, at, axes, s, out.tangent, n, i);
    }
    return {};
  }

 private:
  using Tensor = principal_stretches::Tensor;
  static constexpr std::size_t chunk = 64, parameter_count = Law::parameter_count;

  /// w at up to 3·chunk stretches, and f(c) = w'/(2λ) with its derivatives by c and by the parameters.
  struct Stretches {
    Stretches() {}  // leaves the arrays as they are: every entry that is read was written before
    std::array<double, 3 * chunk> lambda, value, first, second;
    std::array<double, 3 * chunk * parameter_count> first_dp, value_dp;

    void respond(std::span<const double> p, std::size_t count, bool energy, bool curvature, bool parameters,
                 bool energy_parameters = false) {
      tunica::respond<Law>(p, {{lambda.data(), count},
                               {value.data(), energy ? count : 0},
                               {first.data(), count},
                               {second.data(), curvature ? count : 0},
                               {value_dp.data(), energy_parameters ? parameter_count * count : 0},
                               {first_dp.data(), parameters ? parameter_count * count : 0}});
    }
    [[nodiscard]] double f(std::size_t k) const { return first[k] / (2 * lambda[k]); }
    [[nodiscard]] double f_prime(std::size_t k) const {
      return (second[k] - first[k] / lambda[k]) / (4 * lambda[k] * lambda[k]);
    }
    [[nodiscard]] double f_dp(std::size_t j, std::size_t k, std::size_t count) const {
      return first_dp[j * count + k] / (2 * lambda[k]);
    }
  };

  /// f[x, y]. Closer than a tenth of their mean: the mean of f' over [x, y], Gauss's rule with five points, whose
  /// error there, of the order (|x − y|/(4 mean))^10, is below rounding.
  static double divided_difference(std::span<const double> p, const Stretches& s, double x, double y, std::size_t a,
                                   std::size_t b) {
    if (!(std::abs(y - x) < 0.05 * (x + y))) return (s.f(b) - s.f(a)) / (y - x);
    constexpr std::array<double, 5> node{0, 0.5384693101056830910, -0.5384693101056830910, 0.9061798459386639928,
                                         -0.9061798459386639928};
    constexpr std::array<double, 5> weight{0.2844444444444444444, 0.2393143352496832340, 0.2393143352496832340,
                                           0.1184634425280945438, 0.1184634425280945438};
    Stretches between;
    for (std::size_t k = 0; k < 5; ++k) between.lambda[k] = std::sqrt(0.5 * (x + y) + 0.5 * (y - x) * node[k]);
    between.respond(p, 5, false, true, false);
    double mean = 0;
    for (std::size_t k = 0; k < 5; ++k) mean += weight[k] * between.f_prime(k);
    return mean;
  }

  static void set_tangent(std::span<const double> p, const principal_stretches::Spectrum& at,
                          const std::array<Tensor, 3>& axes, const Stretches& s, std::span<double> tangent,
                          std::size_t n, std::size_t i) {
    std::array<Tensor, 3> turns;
    std::array<double, 3> along, turning;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3;
      along[a] = 4 * s.f_prime(a);
      turns[a] = principal_stretches::dyad(at.n[a], at.n[b]);
      turning[a] = 8 * divided_difference(p, s, at.c[a], at.c[b], a, b);  // the pair counts as (a, b) and (b, a)
    }
    for (std::size_t row = 0; row < 6; ++row)
      for (std::size_t column = 0; column < 6; ++column) {
        double sum = 0;
        for (std::size_t a = 0; a < 3; ++a)
          sum += along[a] * axes[a][row] * axes[a][column] + turning[a] * turns[a][row] * turns[a][column];
        tangent[(6 * row + column) * n + i] = sum;
      }
  }

  ModelDescription description_;
};

}  // namespace tunica
