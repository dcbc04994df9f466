// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "tunica/detail/hyperelastic_tensor.hpp"
#include "tunica/models/autodiff.hpp"
#include "tunica/plugin.hpp"

namespace tunica {

/// A model whose energy is one function of several invariants together, W(C; p) = Ψ(x_1, …, x_m; p), with x_k(C; p) as
/// in InvariantOf. Only that function has to be written.
///
/// If W is a sum of functions of one invariant each, take Hyperelastic: it is faster, and mechanisms can change its
/// parts. This class exposes no parts; mechanisms that add energy or memory apply to it all the same. An Energy is a
/// type with
///
///     static constexpr const char *type, *doc, *reference;
///     static constexpr std::size_t parameter_count, invariant_count;
///     static std::vector<Parameter> parameters();
///     template <class T> static std::array<InvariantOf<T>, invariant_count> invariants(std::span<const T> p);
///     template <class T> static T energy(std::span<const T> x, std::span<const T> p);
///     static std::vector<Combination> admissible();                        // optional, as in ModelDescription
///
/// Threads and failure: as Model. Mathematics: with G_k = ∂x_k/∂C, S = 2 Σ_k Ψ_k G_k and 2 ∂S/∂C = 4 Σ_kl Ψ_kl G_k ⊗
/// G_l + 4 Σ_k Ψ_k i2_k (1⊗1 − 𝕀); derivatives of Ψ come from automatic differentiation over (x; p), and only those
/// that are wanted.
template <class Energy>
class JointEnergy final : public Model {
 public:
  JointEnergy() {
    description_.type = Energy::type;
    description_.parameters = Energy::parameters();
    description_.principal_axes = true;
    description_.energy_derivatives = true;
    if constexpr (requires { Energy::admissible(); }) description_.admissible = Energy::admissible();
    if (description_.parameters.size() != Energy::parameter_count)
      throw std::invalid_argument("the energy declares another number of parameters than it counts");
  }

  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const std::size_t n = points.count;
    const Frame frame(points.parameters, !out.stress_dp.empty());
    const int order = !out.stress_dp.empty() ? 3 : !out.tangent.empty() ? 2 : 1;
    for (std::size_t i = 0; i < n; ++i) {
      Tensor C;
      for (std::size_t c = 0; c < 6; ++c) C[c] = points.C[c * n + i];
      const Point at(frame, C, points.parameters, order);
      if (!out.energy.empty()) out.energy[i] = at.value;
      for (std::size_t c = 0; !out.stress.empty() && c < 6; ++c) out.stress[c * n + i] = 2 * at.slope(c);
      for (std::size_t p = 0; !out.tangent.empty() && p < 6; ++p)
        for (std::size_t q = 0; q < 6; ++q) {
          const double identity = p == q ? (p < 3 ? 1. : 0.5) : 0.;
          out.tangent[(6 * p + q) * n + i] = 4 * at.curvature(p, q, (p < 3 && q < 3 ? 1. : 0.) - identity);
        }
      for (std::size_t j = 0; !out.stress_dp.empty() && j < parameters; ++j)
        for (std::size_t c = 0; c < 6; ++c) out.stress_dp[(6 * j + c) * n + i] = 2 * at.slope_dp(frame, C, j, c);
    }
    return {};
  }

  Status evaluate_axes(const AxisPoints& points, const AxisResponse& out) const override {
    static constexpr std::array<std::array<std::size_t, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
    const std::size_t n = points.count;
    const bool derivatives = !out.gradient_dp.empty() || !out.energy_dp.empty();
    const Frame frame(points.parameters, derivatives);
    const int order = derivatives ? 3 : !out.hessian.empty() ? 2 : 1;
    for (std::size_t i = 0; i < n; ++i) {
      const Tensor C{points.c[i], points.c[n + i], points.c[2 * n + i], 0, 0, 0};
      const Point at(frame, C, points.parameters, order);
      if (!out.energy.empty()) out.energy[i] = at.value;
      for (std::size_t a = 0; !out.gradient.empty() && a < 3; ++a) out.gradient[a * n + i] = at.slope(a);
      for (std::size_t k = 0; !out.hessian.empty() && k < 6; ++k)
        out.hessian[k * n + i] = at.curvature(pair[k][0], pair[k][1], pair[k][0] != pair[k][1] ? 1. : 0.);
      for (std::size_t j = 0; !out.gradient_dp.empty() && j < parameters; ++j)
        for (std::size_t a = 0; a < 3; ++a) out.gradient_dp[(3 * j + a) * n + i] = at.slope_dp(frame, C, j, a);
      for (std::size_t j = 0; !out.energy_dp.empty() && j < parameters; ++j)
        out.energy_dp[j * n + i] = at.energy_dp(frame, C, j);
    }
    return {};
  }

 private:
  static constexpr std::size_t m = Energy::invariant_count, parameters = Energy::parameter_count;
  using Tensor = std::array<double, 6>;

  /// What is the same at all points: the invariants, and their derivatives by parameters.
  struct Frame {
    std::array<hyperelastic::Structure, m> x;
    std::array<std::array<hyperelastic::Structure, m>, parameters> x_dp;
    std::array<bool, parameters> moves{};  ///< the invariants depend on it

    Frame(std::span<const double> p, bool derivatives) {
      const auto values = Energy::template invariants<double>(p);
      std::array<hyperelastic::Direction, m> direction;
      for (std::size_t k = 0; k < m; ++k) {
        direction[k] = {values[k], 1};
        x[k] = hyperelastic::structure(values[k], direction[k]);
      }
      if (!derivatives) return;
      using Jet = ceres::Jet<double, static_cast<int>(parameters)>;
      std::array<Jet, parameters> jets;
      for (std::size_t j = 0; j < parameters; ++j) jets[j] = Jet(p[j], static_cast<int>(j));
      const auto by_p = Energy::template invariants<Jet>(std::span<const Jet>(jets));
      for (std::size_t j = 0; j < parameters; ++j)
        for (std::size_t k = 0; k < m; ++k) {
          const auto& v = by_p[k];
          const Invariant d{v.i1.v[j],     v.i2.v[j],     v.fibre.v[j], v.normal.v[j],
                            v.across.v[j], v.offset.v[j], v.angle.v[j]};
          moves[j] = moves[j] || d.i1 != 0 || d.i2 != 0 || d.fibre != 0 || d.normal != 0 || d.across != 0 ||
                     d.offset != 0 || d.angle != 0;
          x_dp[j][k] = hyperelastic::structure_derivative(values[k], d, direction[k], 1);
        }
    }
  };

  /// Ψ and its derivatives at one point. `order` 1: Ψ_k; 2: Ψ_kl too; 3: ∂Ψ_k/∂p_j as well.
  struct Point {
    double value = 0;
    std::array<double, m> first{};
    std::array<std::array<double, m>, m> second{};
    std::array<std::array<double, parameters>, m> first_dp{};
    std::array<double, parameters> value_dp{};
    std::array<Tensor, m> G;
    std::array<double, m> i2;

    Point(const Frame& frame, const Tensor& C, std::span<const double> p, int order) {
      std::array<double, m> x;
      for (std::size_t k = 0; k < m; ++k) {
        x[k] = hyperelastic::invariant_value(frame.x[k], C);
        G[k] = hyperelastic::invariant_slope(frame.x[k], C);
        i2[k] = frame.x[k].i2;
      }
      if (order == 1)
        respond_first(x, p);
      else if (order == 2)
        respond_second<m>(x, p);
      else
        respond_second<m + parameters>(x, p);
    }

    void respond_first(const std::array<double, m>& x, std::span<const double> p) {
      using Jet = ceres::Jet<double, static_cast<int>(m)>;
      std::array<Jet, m> xs;
      std::array<Jet, parameters> ps;
      for (std::size_t k = 0; k < m; ++k) xs[k] = Jet(x[k], static_cast<int>(k));
      for (std::size_t j = 0; j < parameters; ++j) ps[j] = Jet(p[j]);
      const Jet w = Energy::template energy<Jet>(std::span<const Jet>(xs), std::span<const Jet>(ps));
      value = w.a;
      for (std::size_t k = 0; k < m; ++k) first[k] = w.v[k];
    }

    /// A jet over x inside one over x, or over (x; p).
    template <std::size_t width>
    void respond_second(const std::array<double, m>& x, std::span<const double> p) {
      using Inner = ceres::Jet<double, static_cast<int>(width)>;
      using Outer = ceres::Jet<Inner, static_cast<int>(m)>;
      std::array<Outer, m> xs;
      std::array<Outer, parameters> ps;
      for (std::size_t k = 0; k < m; ++k) {
        xs[k] = Outer(Inner(x[k], static_cast<int>(k)));
        xs[k].v[k] = Inner(1.0);
      }
      for (std::size_t j = 0; j < parameters; ++j)
        ps[j] = Outer(width > m ? Inner(p[j], static_cast<int>(m + j)) : Inner(p[j]));
      const Outer w = Energy::template energy<Outer>(std::span<const Outer>(xs), std::span<const Outer>(ps));
      value = w.a.a;
      if constexpr (width > m)
        for (std::size_t j = 0; j < parameters; ++j) value_dp[j] = w.a.v[m + j];
      for (std::size_t k = 0; k < m; ++k) {
        first[k] = w.a.v[k];
        for (std::size_t l = 0; l < m; ++l) second[k][l] = w.v[k].v[l];
        if constexpr (width > m)
          for (std::size_t j = 0; j < parameters; ++j) first_dp[k][j] = w.v[k].v[m + j];
      }
    }

    [[nodiscard]] double slope(std::size_t c) const {
      double sum = 0;
      for (std::size_t k = 0; k < m; ++k) sum += first[k] * G[k][c];
      return sum;
    }
    [[nodiscard]] double curvature(std::size_t p, std::size_t q, double of_i2) const {
      double sum = 0;
      for (std::size_t k = 0; k < m; ++k) {
        for (std::size_t l = 0; l < m; ++l) sum += second[k][l] * G[k][p] * G[l][q];
        sum += first[k] * i2[k] * of_i2;
      }
      return sum;
    }
    /// ∂Ψ/∂p + Σ_l Ψ_l ∂x_l/∂p
    [[nodiscard]] double energy_dp(const Frame& frame, const Tensor& C, std::size_t j) const {
      double sum = value_dp[j];
      for (std::size_t l = 0; frame.moves[j] && l < m; ++l)
        sum += first[l] * hyperelastic::invariant_value(frame.x_dp[j][l], C);
      return sum;
    }
    /// Σ_k (∂Ψ_k/∂p + Σ_l Ψ_kl ∂x_l/∂p) G_k + Ψ_k ∂G_k/∂p
    [[nodiscard]] double slope_dp(const Frame& frame, const Tensor& C, std::size_t j, std::size_t c) const {
      double sum = 0;
      for (std::size_t k = 0; k < m; ++k) sum += first_dp[k][j] * G[k][c];
      if (!frame.moves[j]) return sum;
      for (std::size_t l = 0; l < m; ++l) {
        const double x_p = hyperelastic::invariant_value(frame.x_dp[j][l], C);
        for (std::size_t k = 0; k < m; ++k) sum += second[k][l] * x_p * G[k][c];
        sum += first[l] * hyperelastic::invariant_slope(frame.x_dp[j][l], C)[c];
      }
      return sum;
    }
  };

  ModelDescription description_;
};

/// What a plugin registers: registry.add(tunica::joint_energy<Fung>());
template <class Energy>
ModelFactory joint_energy() {
  return {Energy::type, Energy::doc, Energy::reference, {}, [](const Options&) -> std::unique_ptr<Model> {
            return std::make_unique<JointEnergy<Energy>>();
          }};
}

}  // namespace tunica
