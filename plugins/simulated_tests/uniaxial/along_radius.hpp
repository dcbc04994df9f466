// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tunica/model.hpp"

namespace tunica::uniaxial {

/// A model seen in axes of which the first is the wall's normal: axes 0, 1, 2 are r, t, z of the model. A strip cut
/// through the thickness is then one pulled along the first axis. It shows no parts, which name the axes, and remembers
/// in tensors only.
class AlongRadius final : public Model {
 public:
  /// `model` outlives this.
  explicit AlongRadius(const Model& model) : model_(model), description_(model.describe()) {
    description_.axis_history_size = 0;
  }

  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const std::size_t n = points.count;
    Rows C(6 * n), stress(out.stress.size()), tangent(out.tangent.size()), stress_dp(out.stress_dp.size());
    for (std::size_t a = 0; a < 6; ++a) copy(points.C, a, C, tensor[a], n);
    const Status status = model_.evaluate({n, C, points.parameters, points.time_step, points.state},
                                          {out.energy, stress, tangent, stress_dp, out.state});
    if (!status.ok()) return status;
    turn(stress, tensor, out.stress, n);
    turn(stress_dp, tensor, out.stress_dp, n);
    for (std::size_t a = 0; a < 6 && !tangent.empty(); ++a)
      for (std::size_t b = 0; b < 6; ++b) copy(tangent, 6 * tensor[a] + tensor[b], out.tangent, 6 * a + b, n);
    return status;
  }

  Status evaluate_axes(const AxisPoints& points, const AxisResponse& out) const override {
    const std::size_t n = points.count;
    Rows c(3 * n), gradient(out.gradient.size()), hessian(out.hessian.size()), gradient_dp(out.gradient_dp.size());
    for (std::size_t a = 0; a < 3; ++a) copy(points.c, a, c, axis[a], n);
    const Status status =
        model_.evaluate_axes({n, c, points.parameters}, {out.energy, gradient, hessian, gradient_dp, out.energy_dp});
    if (!status.ok()) return status;
    turn(gradient, axis, out.gradient, n);
    turn(hessian, tensor, out.hessian, n);
    turn(gradient_dp, axis, out.gradient_dp, n);
    return status;
  }

 private:
  using Rows = std::vector<double>;
  static constexpr std::array<std::size_t, 3> axis{2, 0, 1};             ///< of the model, by axis here
  static constexpr std::array<std::size_t, 6> tensor{2, 0, 1, 5, 3, 4};  ///< the same of a tensor's components

  static void copy(std::span<const double> from, std::size_t row, std::span<double> to, std::size_t at, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) to[at * n + i] = from[row * n + i];
  }
  /// Groups of rows, one after the other; nothing where nothing is wanted.
  template <std::size_t count>
  static void turn(std::span<const double> from, const std::array<std::size_t, count>& map, std::span<double> to,
                   std::size_t n) {
    for (std::size_t first = 0; first * n < to.size(); first += count)
      for (std::size_t a = 0; a < count; ++a) copy(from, first + map[a], to, first + a, n);
  }

  const Model& model_;
  ModelDescription description_;
};

}  // namespace tunica::uniaxial
