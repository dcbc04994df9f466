// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tunica/detail/joint_lanes.hpp"
#include "tunica/detail/strip_derivatives.hpp"
#include "tunica/strip_path.hpp"

namespace tunica::joint {

/// W(l, y) of a JointEnergy along one strip, for hyperelastic::StripSolver. With h = 2 l, so that c1 = e^h and c3 =
/// e^(−h−y): the names of strip_lanes.hpp are W_h = ½ W_l, W_hy = ½ W_ly and W_hh = ¼ W_ll.
template <class Energy>
class Strip {
 public:
  Strip(const StripPath& strip, bool by_parameters)
      : frame_(strip.parameters, by_parameters), axial_(strip.loaded == 1) {}

  /// c3, the derivatives of W at u, Newton's step, and σ after it.
  template <std::size_t width>
  [[gnu::always_inline]] void evaluate(hyperelastic::StripLanes& s, std::size_t lanes) const {
    at_points<width>(
        lanes,
        [&](const Place<width>& place)
            __attribute__((always_inline)) { return along<false, Variable::y>(coordinates(s, place)); },
        [&](const Place<width>& place, const auto& w) __attribute__((always_inline)) {
          place.store(s.by_y.data(), w.x);
          place.store(s.by_yy.data(), w.xx);
          place.store(s.by_l.data(), w.p[0]);
          place.store(s.by_ly.data(), w.xp[0]);
        });
    set_c3(s, lanes);
    hyperelastic::end_strip(s, lanes);
  }

  /// c3, W_yy, ½ W_ly and ¼ W_ll at u; with `by_parameters` W_yp and ½ W_lp too.
  template <std::size_t width>
  [[gnu::always_inline]] void differentiate(hyperelastic::StripLanes& s, bool by_parameters,
                                            hyperelastic::StripByParameters& by_p, std::size_t lanes) const {
    if (by_parameters)
      differentiate<width, true>(s, by_p, lanes);
    else
      differentiate<width, false>(s, by_p, lanes);
    set_c3(s, lanes);
  }

 private:
  static constexpr std::size_t invariants = Energy::invariant_count, parameters = Energy::parameter_count;
  enum class Variable { y, h };
  template <class Number>
  struct Coordinates {
    Number c1, c2, c3;
  };

  template <std::size_t width>
  [[gnu::always_inline]] static Coordinates<detail::Lanes<width>> coordinates(const hyperelastic::StripLanes& s,
                                                                              const Place<width>& place) {
    const auto c1 = place.load(s.c1.data()), c2 = place.load(s.u.data());
    return {c1, c2, 1 / (c1 * c2)};
  }
  [[gnu::always_inline]] static void set_c3(hyperelastic::StripLanes& s, std::size_t lanes) {
    TUNICA_LANES
    for (std::size_t i = 0; i < lanes; ++i) s.c3[i] = 1 / (s.c1[i] * s.u[i]);
  }

  template <std::size_t width, bool by_parameters>
  [[gnu::always_inline]] void differentiate(hyperelastic::StripLanes& s, hyperelastic::StripByParameters& by_p,
                                            std::size_t lanes) const {
    at_points<width>(
        lanes,
        [&](const Place<width>& place)
            __attribute__((always_inline)) { return along<by_parameters, Variable::y>(coordinates(s, place)); },
        [&](const Place<width>& place, const auto& w) __attribute__((always_inline)) {
          place.store(s.by_yy.data(), w.xx);
          place.store(s.by_ly.data(), w.xp[0]);
          for (std::size_t j = 0; j < w.xp.size() - 1; ++j) place.store(by_p.y[j].data(), w.xp[1 + j]);
        });
    at_points<width>(
        lanes,
        [&](const Place<width>& place)
            __attribute__((always_inline)) { return along<by_parameters, Variable::h>(coordinates(s, place)); },
        [&](const Place<width>& place, const auto& w) __attribute__((always_inline)) {
          place.store(s.by_ll.data(), w.xx);
          for (std::size_t j = 0; j < w.xp.size() - 1; ++j) place.store(by_p.l[j].data(), w.xp[1 + j]);
        });
    for (std::size_t j = 0; by_parameters && j < parameters; ++j) by_p.written.set(j);
  }

  /// x and its derivatives by y and h, mixed and twice; those of its derivative by a parameter too, which is such a
  /// form of c as well.
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

  /// Ψ by the variable, twice; p[0] is the other one, parameter j at p[1 + j].
  template <bool by_parameters, Variable variable, class Number>
  TUNICA_FOR_KERNELS auto along(const Coordinates<Number>& at) const {
    using T = Taylor<1 + (by_parameters ? parameters : 0), Number>;
    constexpr bool is_y = variable == Variable::y;
    std::array<T, invariants> x;
    for (std::size_t k = 0; k < invariants; ++k) {
      const Form<Number> form(frame_.x[k], axial_, at);
      x[k] = T(form.value);
      x[k].x = is_y ? form.y : form.h;
      x[k].xx = is_y ? form.yy : form.hh;
      x[k].p[0] = is_y ? form.h : form.y;
      x[k].xp[0] = form.hy;
      if constexpr (by_parameters)
        for (std::size_t j = 0; j < parameters; ++j) {
          if (!frame_.moves[j]) continue;
          const Form<Number> change(frame_.x_dp[j][k], axial_, at);
          x[k].p[1 + j] = change.value;
          x[k].xp[1 + j] = is_y ? change.y : change.h;
        }
    }
    std::array<T, parameters> p;
    for (std::size_t j = 0; j < parameters; ++j) {
      p[j] = T(Number(frame_.p[j]));
      if constexpr (by_parameters) p[j].p[1 + j] = 1;
    }
    return Energy::template energy<T>(std::span<const T>(x), std::span<const T>(p));
  }

  Frame<Energy> frame_;
  bool axial_;
};

}  // namespace tunica::joint
