// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <ceres/jet.h>

#include "tunica/detail/hyperelastic_part_batch.hpp"
#include "tunica/detail/lanes.hpp"
#include "tunica/detail/taylor.hpp"
#include "tunica/detail/vector_level.hpp"
#include "tunica/models/jet_functions.hpp"

/// Derivatives of W = Ψ(x_1, …, x_m; p) over lanes of points, for JointEnergy.
///
/// The invariants are entered as Taylor numbers in the variables that are asked for, so that one evaluation of Ψ
/// carries all of the chain rule. It gives derivatives by one variable, twice, and by others and the parameters, mixed
/// with it.
namespace tunica::joint {

/// What is the same at all points: the invariants, and their derivatives by parameters.
template <class Energy>
struct Frame {
  static constexpr std::size_t invariants = Energy::invariant_count, parameters = Energy::parameter_count;
  std::span<const double> p;
  std::array<hyperelastic::Structure, invariants> x;
  std::array<std::array<hyperelastic::Structure, invariants>, parameters> x_dp;
  std::array<bool, parameters> moves{};  ///< the invariants depend on it

  Frame(std::span<const double> at, bool derivatives) : p(at) {
    const auto values = Energy::template invariants<double>(p);
    std::array<hyperelastic::Direction, invariants> direction;
    for (std::size_t k = 0; k < invariants; ++k) {
      direction[k] = {values[k], 1};
      x[k] = hyperelastic::structure(values[k], direction[k]);
    }
    if (!derivatives) return;
    using Jet = ceres::Jet<double, static_cast<int>(parameters)>;
    std::array<Jet, parameters> jets;
    for (std::size_t j = 0; j < parameters; ++j) jets[j] = Jet(p[j], static_cast<int>(j));
    const auto by_p = Energy::template invariants<Jet>(std::span<const Jet>(jets));
    for (std::size_t j = 0; j < parameters; ++j)
      for (std::size_t k = 0; k < invariants; ++k) {
        const auto& v = by_p[k];
        const Invariant d{v.i1.v[j],     v.i2.v[j],     v.fibre.v[j], v.normal.v[j],
                          v.across.v[j], v.offset.v[j], v.angle.v[j]};
        moves[j] = moves[j] || d.i1 != 0 || d.i2 != 0 || d.fibre != 0 || d.normal != 0 || d.across != 0 ||
                   d.offset != 0 || d.angle != 0;
        x_dp[j][k] = hyperelastic::structure_derivative(values[k], d, direction[k], 1);
      }
  }
};

/// Which points lie in the lanes, and of which lanes the results are taken.
template <std::size_t width>
struct Place {
  using Number = detail::Lanes<width>;
  static constexpr unsigned all = (1U << width) - 1;
  std::array<std::size_t, width> at;
  bool in_order;         ///< at[l] = at[0] + l
  unsigned taken = all;  ///< a bit a lane

  [[gnu::always_inline]] Number load(const double* from) const {
    if (in_order) return Number::load(from + at[0]);
    Number x;
    for (std::size_t l = 0; l < width; ++l) x.v[l] = from[at[l]];
    return x;
  }
  [[gnu::always_inline]] void store(double* to, const Number& x) const {
    if (in_order && taken == all) return x.store(to + at[0]);
    for (std::size_t l = 0; l < width; ++l)
      if ((taken >> l & 1) != 0) to[at[l]] = x.v[l];
  }
};

/// `evaluate(place)` evaluates formulas at the points of a Place, and `store(place, result)` what it returns, for n
/// points. Lanes that took another branch than the first one are evaluated again, one of them in front.
template <std::size_t width, class Evaluate, class Store>
[[gnu::always_inline]] inline void at_points(std::size_t n, const Evaluate& evaluate, const Store& store) {
  for (std::size_t begin = 0; begin < n; begin += width) {
    Place<width> place;
    for (std::size_t l = 0; l < width; ++l) place.at[l] = std::min(begin + l, n - 1);
    place.in_order = n - begin >= width;
    unsigned open = place.in_order ? place.all : (1U << (n - begin)) - 1;
    while (open != 0) {
      detail::lanes_in_step = place.all;
      const auto result = evaluate(place);
      place.taken = open & detail::lanes_in_step;  // the first lane is among them
      store(place, result);
      open &= ~place.taken;
      if (open == 0) break;
      std::size_t front = 0;
      while ((open >> front & 1) == 0) ++front;
      for (std::size_t l = 0; l < width; ++l)
        if ((open >> l & 1) == 0) place.at[l] = place.at[front];
      open = (open & ~(1U << front)) | 1U;
      place.in_order = false;
    }
  }
}

/// ∂²I2/∂C_a∂C_b for components tt, zz, rr, tz, zr, tr: 1⊗1 − 𝕀.
[[gnu::always_inline]] inline double bend(std::size_t a, std::size_t b) {
  return (a < 3 && b < 3 ? 1. : 0.) - (a == b ? (a < 3 ? 1. : 0.5) : 0.);
}

/// Ψ in `components` of C: 3 on principal axes, or all 6.
template <class Energy, std::size_t components, bool by_parameters>
class Points {
 public:
  static constexpr std::size_t invariants = Energy::invariant_count, parameters = Energy::parameter_count;
  static constexpr std::size_t others = components - 1, directions = others + (by_parameters ? parameters : 0);

  explicit Points(const Frame<Energy>& frame) : frame_(frame) {}

  /// Ψ with derivatives by component `a`, twice, and by all others and the parameters mixed with it. Component b is at
  /// p[(b − a − 1) mod components], parameter j at p[others + j].
  template <class Number>
  TUNICA_FOR_KERNELS Taylor<directions, Number> along(std::size_t a, const std::array<Number, components>& C) const {
    using T = Taylor<directions, Number>;
    std::array<T, invariants> x;
    for (std::size_t k = 0; k < invariants; ++k) {
      const hyperelastic::Structure& s = frame_.x[k];
      const auto slope = slopes(s, C);
      x[k] = T(value(s, C));
      x[k].x = slope[a];
      x[k].xx = s.i2 * bend(a, a);
      for (std::size_t o = 0; o < others; ++o) {
        const std::size_t b = (a + 1 + o) % components;
        x[k].p[o] = slope[b];
        x[k].xp[o] = s.i2 * bend(a, b);
      }
      if constexpr (by_parameters)
        for (std::size_t j = 0; j < parameters; ++j) {
          if (!frame_.moves[j]) continue;
          x[k].p[others + j] = value(frame_.x_dp[j][k], C);
          x[k].xp[others + j] = slopes(frame_.x_dp[j][k], C)[a];
        }
    }
    std::array<T, parameters> p;
    for (std::size_t j = 0; j < parameters; ++j) {
      const Number value(frame_.p[j]);
      p[j] = by_parameters ? T::parameter(value, (others + j) % directions) : T(value);
    }
    return Energy::template energy<T>(std::span<const T>(x), std::span<const T>(p));
  }

 private:
  /// As hyperelastic::invariant_value() and invariant_slope().
  template <class Number>
  [[gnu::always_inline]] static Number value(const hyperelastic::Structure& s,
                                             const std::array<Number, components>& C) {
    Number x = s.tt * C[0] + s.zz * C[1] + s.rr * C[2] + s.offset;
    if constexpr (components == 6) x += 2 * (s.tz * C[3] + s.zr * C[4] + s.tr * C[5]);
    if (s.i2 != 0) {
      Number i2 = C[0] * C[1] + C[1] * C[2] + C[2] * C[0];
      if constexpr (components == 6) i2 -= C[3] * C[3] + C[4] * C[4] + C[5] * C[5];
      x += s.i2 * i2;
    }
    return x;
  }
  template <class Number>
  [[gnu::always_inline]] static std::array<Number, components> slopes(const hyperelastic::Structure& s,
                                                                      const std::array<Number, components>& C) {
    std::array<Number, components> slope{s.tt, s.zz, s.rr};
    if constexpr (components == 6) {
      slope[3] = s.tz;
      slope[4] = s.zr;
      slope[5] = s.tr;
    }
    if (s.i2 == 0) return slope;
    const Number i1 = C[0] + C[1] + C[2];
    for (std::size_t c = 0; c < components; ++c) slope[c] += s.i2 * (c < 3 ? i1 - C[c] : -C[c]);
    return slope;
  }

  const Frame<Energy>& frame_;
};

}  // namespace tunica::joint
