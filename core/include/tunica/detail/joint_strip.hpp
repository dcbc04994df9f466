// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "tunica/detail/joint_lanes.hpp"
#include "tunica/detail/strip_derivatives.hpp"
#include "tunica/strip_path.hpp"

namespace tunica::joint {

/// W(l, y) of a JointEnergy along one strip, for hyperelastic::StripSolver. With h = 2 l, c1 = e^h and c3 = e^(−h−y).
/// What strip_lanes.hpp names ½ W_l, ½ W_ly and ¼ W_ll is W_h, W_hy and W_hh.
template <class Energy>
class Strip {
 public:
  Strip(const StripPath& strip, bool by_parameters)
      : frame_(strip.parameters, by_parameters),
        axial_(strip.loaded == 1),
        by_stretch_(!strip.stress_by_l.empty()),
        lateral_(!strip.lateral_dp.empty()) {}

  /// The derivatives of W at u, Newton's step, and σ after it.
  template <std::size_t width>
  [[gnu::always_inline]] void evaluate(hyperelastic::StripLanes& s, std::size_t lanes) const {
    pass<width, Beside::other, Variable::y>(
        s, lanes, [&](const auto& place, const auto& w) __attribute__((always_inline)) {
          place.store(s.by_y.data(), w.x);
          place.store(s.by_yy.data(), w.xx);
          place.store(s.by_l.data(), w.p[0]);
          place.store(s.by_ly.data(), w.xp[0]);
        });
    hyperelastic::end_strip(s, lanes);
  }

  /// W_yy and ½ W_ly at u, and ¼ W_ll where it is wanted. With `by_parameters` W_yp and ½ W_lp too; where nobody
  /// asks for y by parameters, what the stress makes of both, at half the cost.
  template <std::size_t width>
  [[gnu::always_inline]] void differentiate(hyperelastic::StripLanes& s, bool by_parameters,
                                            hyperelastic::StripByParameters& by_p, std::size_t lanes) const {
    pass<width, Beside::other, Variable::y>(
        s, lanes, [&](const auto& place, const auto& w) __attribute__((always_inline)) {
          place.store(s.by_yy.data(), w.xx);
          place.store(s.by_ly.data(), w.xp[0]);
        });
    if (by_stretch_)
      pass<width, Beside::nothing, Variable::h>(
          s, lanes, [&](const auto& place, const auto& w) __attribute__((always_inline)) {
            place.store(s.by_ll.data(), w.xx);
          });
    if (by_parameters && lateral_) {
      parameter_pass<width, Variable::y>(s, by_p.y, lanes);
      parameter_pass<width, Variable::h>(s, by_p.l, lanes);
    } else if (by_parameters) {
      parameter_pass<width, Variable::path>(s, by_p.l, lanes);
      by_p.along_path = true;
    }
    for (std::size_t j = 0; by_parameters && j < parameters; ++j) by_p.written.set(j);
  }

 private:
  static constexpr std::size_t invariants = Energy::invariant_count, parameters = Energy::parameter_count;
  /// `path`: h, with y in equilibrium to first order, so that ∂x = x_h − W_hy/W_yy x_y.
  enum class Variable { y, h, path };
  /// What derivatives are mixed with: nothing, the other one of y and h, or all parameters.
  enum class Beside { nothing, other, parameters };
  template <class Number>
  struct Coordinates {
    Number c1, c2, c3, follows;  ///< follows: W_hy/W_yy
  };

  template <std::size_t width>
  [[gnu::always_inline]] static Coordinates<detail::Lanes<width>> coordinates(const hyperelastic::StripLanes& s,
                                                                              const Place<width>& place, bool on_path) {
    const auto c1 = place.load(s.c1.data()), c2 = place.load(s.u.data());
    if (!on_path) return {c1, c2, 1 / (c1 * c2), 0};
    return {c1, c2, 1 / (c1 * c2), place.load(s.by_ly.data()) / place.load(s.by_yy.data())};
  }

  /// Ψ by the variable, and what stands beside it, at all lanes; store(place, Ψ).
  template <std::size_t width, Beside beside, Variable variable, class Store>
  [[gnu::always_inline]] void pass(const hyperelastic::StripLanes& s, std::size_t lanes, const Store& store) const {
    detail::apart<width>([&]() __attribute__((always_inline)) {
      at_points<width>(
          lanes,
          [&](const Place<width>& place) __attribute__((always_inline)) {
            return along<beside, variable>(coordinates(s, place, variable == Variable::path));
          },
          store);
    });
  }
  /// The derivatives by the variable and the parameters.
  template <std::size_t width, Variable variable, class Rows>
  [[gnu::always_inline]] void parameter_pass(const hyperelastic::StripLanes& s, Rows& rows, std::size_t lanes) const {
    pass<width, Beside::parameters, variable>(
        s, lanes, [&](const auto& place, const auto& w) __attribute__((always_inline)) {
          for (std::size_t j = 0; j < parameters; ++j) place.store(rows[j].data(), w.xp[j]);
        });
  }

  /// x and its derivatives by y and h, mixed and twice. What a parameter changes in x is such a form as well.
  template <class Number>
  struct Form {
    Number value, y, h, yy, hy, hh;

    [[gnu::always_inline]] Form(const hyperelastic::Structure& s, bool axial, const Coordinates<Number>& at) {
      const Number x1 = (axial ? s.zz : s.tt) * at.c1, x2 = (axial ? s.tt : s.zz) * at.c2, x3 = s.rr * at.c3;
      value = x1 + x2 + x3 + s.offset;
      y = x2 - x3;
      h = x1 - x3;
      yy = x2 + x3;
      hy = x3;
      hh = x1 + x3;
      if (s.i2 == 0) return;
      const Number p12 = s.i2 * (at.c1 * at.c2), p23 = s.i2 * (at.c2 * at.c3), p31 = s.i2 * (at.c3 * at.c1);
      value += p12 + p23 + p31;
      y += p12 - p31;
      h += p12 - p23;
      yy += p12 + p31;
      hy += p12;
      hh += p12 + p23;
    }
  };

  /// Ψ by the variable, twice but for `path`; p[0] is by the other one, or p[j] by parameter j.
  template <Beside beside, Variable variable, class Number>
  TUNICA_FOR_KERNELS auto along(const Coordinates<Number>& at) const {
    using T = Taylor<beside == Beside::parameters ? parameters : beside == Beside::other ? 1 : 0, Number>;
    // Written out, so that what is the same at all points is seen to be.
    const auto x = [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
      return std::array<T, invariants>{invariant<T, beside, variable>(k, at)...};
    }
    (std::make_index_sequence<invariants>());
    const auto p = [&]<std::size_t... j>(std::index_sequence<j...>) __attribute__((always_inline)) {
      if constexpr (beside == Beside::parameters)
        return std::array<T, parameters>{T::parameter(Number(frame_.p[j]), j)...};
      else
        return std::array<T, parameters>{T(Number(frame_.p[j]))...};
    }
    (std::make_index_sequence<parameters>());
    return Energy::template energy<T>(std::span<const T>(x), std::span<const T>(p));
  }

  /// Invariant k as a number of along().
  template <class T, Beside beside, Variable variable, class Number>
  [[gnu::always_inline]] T invariant(std::size_t k, const Coordinates<Number>& at) const {
    constexpr bool is_y = variable == Variable::y;
    const auto slope = [&at](const Form<Number>& x) __attribute__((always_inline)) {
      return is_y ? x.y : variable == Variable::h ? x.h : x.h - at.follows * x.y;
    };
    const Form<Number> form(frame_.x[k], axial_, at);
    T x(form.value);
    x.x = slope(form);
    if constexpr (variable != Variable::path) x.xx = is_y ? form.yy : form.hh;
    if constexpr (beside == Beside::other) {
      x.p[0] = is_y ? form.h : form.y;
      x.xp[0] = form.hy;
    }
    if constexpr (beside == Beside::parameters)
      for (std::size_t j = 0; j < parameters; ++j) {
        if (!frame_.moves[j]) continue;
        const Form<Number> change(frame_.x_dp[j][k], axial_, at);
        x.p[j] = change.value;
        x.xp[j] = slope(change);
      }
    return x;
  }

  Frame<Energy> frame_;
  bool axial_, by_stretch_, lateral_;
};

}  // namespace tunica::joint
