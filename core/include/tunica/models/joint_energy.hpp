// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>

#include "tunica/detail/joint_lanes.hpp"
#include "tunica/detail/joint_strip.hpp"
#include "tunica/detail/strip_solver.hpp"
#include "tunica/detail/symmetric_strip.hpp"
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
/// Threads and failure: as Model. Mathematics: S = 2 ∂W/∂C and 2 ∂S/∂C = 4 ∂²W/∂C², by automatic differentiation. Ψ is
/// evaluated on Taylor numbers (tunica/detail/taylor.hpp), several points at once in the lanes of a vector
/// (tunica/detail/lanes.hpp). jet_functions.hpp lists the functions of these numbers. `energy` may compare them, but
/// not convert them.
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
    if (!out.stress_dp.empty())
      on_tensors<true>(points, out);
    else
      on_tensors<false>(points, out);
    return {};
  }

  Status evaluate_axes(const AxisPoints& points, const AxisResponse& out) const override {
    if (!out.gradient_dp.empty() || !out.energy_dp.empty())
      on_axes<true>(points, out);
    else
      on_axes<false>(points, out);
    return {};
  }

  bool solve_strip(const StripPath& strip, Status& status) const override {
    const auto invariants = Energy::template invariants<double>(strip.parameters);
    if (std::all_of(invariants.begin(), invariants.end(), free_strip::is_isotropic)) return false;
    status = hyperelastic::solve_strip<joint::Strip<Energy>>(*this, strip, strip, !strip.stress_dp.empty());
    return true;
  }

 private:
  static constexpr std::size_t parameters = Energy::parameter_count;
  static_assert(parameters <= hyperelastic::max_model_parameters);

  template <bool by_parameters>
  static void on_axes(const AxisPoints& points, const AxisResponse& out) {
    constexpr std::size_t components = 3;
    using Points = joint::Points<Energy, components, by_parameters>;
    // Rows of the Hessian: tt, zz, rr, tz, zr, tr.
    constexpr std::array<std::array<std::size_t, 3>, 3> row{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};
    const joint::Frame<Energy> frame(points.parameters, by_parameters);
    const std::size_t n = points.count, axes = by_parameters || !out.hessian.empty() ? components : 1;
    detail::vectorised([&](auto width) __attribute__((always_inline)) {
      const Points at(frame);
      for (std::size_t a = 0; a < axes; ++a)
        joint::at_points<width>(
            n,
            [&](const auto& place)
                __attribute__((always_inline)) { return at.along(a, loaded<components>(place, points.c, n)); },
            [&](const auto& place, const auto& w) __attribute__((always_inline)) {
              if (a == 0 && !out.energy.empty()) place.store(out.energy.data(), w.value);
              if (a == 0 && !out.gradient.empty()) {
                place.store(out.gradient.data(), w.x);
                for (std::size_t b = 1; b < components; ++b) place.store(out.gradient.data() + b * n, w.p[b - 1]);
              }
              if (!out.hessian.empty()) {
                place.store(out.hessian.data() + row[a][a] * n, w.xx);
                for (std::size_t b = a + 1; b < components; ++b)
                  place.store(out.hessian.data() + row[a][b] * n, w.xp[b - a - 1]);
              }
              if constexpr (by_parameters)
                for (std::size_t j = 0; j < parameters; ++j) {
                  if (a == 0 && !out.energy_dp.empty())
                    place.store(out.energy_dp.data() + j * n, w.p[Points::others + j]);
                  if (!out.gradient_dp.empty())
                    place.store(out.gradient_dp.data() + (3 * j + a) * n, w.xp[Points::others + j]);
                }
            });
    });
  }

  template <bool by_parameters>
  static void on_tensors(const MaterialPoints& points, const MaterialResponse& out) {
    constexpr std::size_t components = 6;
    using Points = joint::Points<Energy, components, by_parameters>;
    const joint::Frame<Energy> frame(points.parameters, by_parameters);
    const std::size_t n = points.count, passes = by_parameters || !out.tangent.empty() ? components : 1;
    detail::vectorised([&](auto width) __attribute__((always_inline)) {
      const Points at(frame);
      for (std::size_t a = 0; a < passes; ++a)
        joint::at_points<width>(
            n,
            [&](const auto& place)
                __attribute__((always_inline)) { return at.along(a, loaded<components>(place, points.C, n)); },
            [&](const auto& place, const auto& w) __attribute__((always_inline)) {
              if (a == 0 && !out.energy.empty()) place.store(out.energy.data(), w.value);
              if (a == 0 && !out.stress.empty()) {
                place.store(out.stress.data(), 2 * w.x);
                for (std::size_t b = 1; b < components; ++b) place.store(out.stress.data() + b * n, 2 * w.p[b - 1]);
              }
              if (!out.tangent.empty()) {
                place.store(out.tangent.data() + 7 * a * n, 4 * w.xx);
                for (std::size_t b = a + 1; b < components; ++b) {
                  place.store(out.tangent.data() + (6 * a + b) * n, 4 * w.xp[b - a - 1]);
                  place.store(out.tangent.data() + (6 * b + a) * n, 4 * w.xp[b - a - 1]);
                }
              }
              if constexpr (by_parameters)
                for (std::size_t j = 0; j < parameters; ++j)
                  place.store(out.stress_dp.data() + (6 * j + a) * n, 2 * w.xp[Points::others + j]);
            });
    });
  }

  /// The components of C at the points of a place.
  template <std::size_t components, class Place>
  [[gnu::always_inline]] static auto loaded(const Place& place, std::span<const double> C, std::size_t n) {
    std::array<typename Place::Number, components> at;
    for (std::size_t c = 0; c < components; ++c) at[c] = place.load(C.data() + c * n);
    return at;
  }

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
