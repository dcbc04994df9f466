// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <numbers>
#include <type_traits>

#include "tunica/detail/vector_math.hpp"

namespace tunica {

/// A number w(x; p) with the derivatives that a response asks for: by x once and twice, by each of n parameters, and by
/// x and a parameter. The arithmetic of a law's formula on it is that of numbers and the chain rule,
///
///     f(w)_x = f' w_x,   f(w)_xx = f' w_xx + f'' w_x²,   f(w)_p = f' w_p,   f(w)_xp = f' w_xp + f'' w_x w_p.
///
/// A Number is a double, or several side by side (lanes.hpp). It holds nothing else and no vectors of a library, so
/// that a loop over points becomes one over lanes. A formula may call what tunica::functions (jet_functions.hpp) lists.
template <std::size_t n, class Number = double>
struct Taylor {
  using Given = std::conditional_t<std::is_arithmetic_v<Number>, Number, const Number&>;  ///< a Number as an argument

  Number value = 0,                 ///< w
      x = 0,                        ///< ∂w/∂x
      xx = 0;                       ///< ∂²w/∂x²
  std::array<Number, n> p{}, xp{};  ///< ∂w/∂p_j, ∂²w/∂x∂p_j

  Taylor() = default;
  /// A number without derivatives.
  explicit Taylor(Given number) : value(number) {}

  /// The argument of the law.
  static Taylor argument(Given at) {
    Taylor w(at);
    w.x = 1;
    return w;
  }
  /// Parameter j.
  static Taylor parameter(Given at, [[maybe_unused]] std::size_t j) {
    Taylor w(at);
    if constexpr (n > 0) w.p[j] = 1;
    return w;
  }

  /// f(w) from f, f' and f''.
  [[nodiscard]] Taylor through(Given f, Given f1, Given f2) const {
    Taylor y(f);
    y.x = f1 * x;
    y.xx = f1 * xx + f2 * (x * x);
    for (std::size_t j = 0; j < n; ++j) {
      y.p[j] = f1 * p[j];
      y.xp[j] = f1 * xp[j] + f2 * (x * p[j]);
    }
    return y;
  }
  /// F(w, g) from F, F_w, F_g, F_ww, F_wg and F_gg.
  [[nodiscard]] Taylor through(const Taylor& g, Given F, Given Fw, Given Fg, Given Fww, Given Fwg, Given Fgg) const {
    Taylor y(F);
    y.x = Fw * x + Fg * g.x;
    y.xx = Fw * xx + Fg * g.xx + Fww * (x * x) + 2 * Fwg * (x * g.x) + Fgg * (g.x * g.x);
    for (std::size_t j = 0; j < n; ++j) {
      y.p[j] = Fw * p[j] + Fg * g.p[j];
      y.xp[j] = Fw * xp[j] + Fg * g.xp[j] + Fww * (x * p[j]) + Fwg * (x * g.p[j] + g.x * p[j]) + Fgg * (g.x * g.p[j]);
    }
    return y;
  }
  /// Whether no derivative differs from zero.
  [[nodiscard]] bool is_constant() const {
    bool found = x == 0 && xx == 0;
    for (std::size_t j = 0; j < n; ++j) found = found && p[j] == 0 && xp[j] == 0;
    return found;
  }

  Taylor& operator+=(const Taylor& g) { return *this = *this + g; }
  Taylor& operator-=(const Taylor& g) { return *this = *this - g; }
  Taylor& operator*=(const Taylor& g) { return *this = *this * g; }
  Taylor& operator/=(const Taylor& g) { return *this = *this / g; }
  Taylor& operator+=(Given s) {
    value += s;
    return *this;
  }
  Taylor& operator-=(Given s) {
    value -= s;
    return *this;
  }
  Taylor& operator*=(Given s) { return *this = *this * s; }
  Taylor& operator/=(Given s) { return *this = *this / s; }

  friend Taylor operator+(const Taylor& f) { return f; }
  friend Taylor operator-(const Taylor& f) { return f * -1.0; }
  friend Taylor operator+(const Taylor& f, const Taylor& g) {
    Taylor y(f.value + g.value);
    y.x = f.x + g.x;
    y.xx = f.xx + g.xx;
    for (std::size_t j = 0; j < n; ++j) {
      y.p[j] = f.p[j] + g.p[j];
      y.xp[j] = f.xp[j] + g.xp[j];
    }
    return y;
  }
  friend Taylor operator-(const Taylor& f, const Taylor& g) { return f + -g; }
  friend Taylor operator*(const Taylor& f, const Taylor& g) {
    Taylor y(f.value * g.value);
    y.x = f.value * g.x + f.x * g.value;
    y.xx = f.value * g.xx + 2 * (f.x * g.x) + f.xx * g.value;
    for (std::size_t j = 0; j < n; ++j) {
      y.p[j] = f.value * g.p[j] + f.p[j] * g.value;
      y.xp[j] = f.value * g.xp[j] + f.x * g.p[j] + f.p[j] * g.x + f.xp[j] * g.value;
    }
    return y;
  }
  friend Taylor operator/(const Taylor& f, const Taylor& g) {
    const Number q = 1 / g.value;
    return f * g.through(q, -q * q, 2 * q * q * q);
  }
  friend Taylor operator+(const Taylor& f, Given s) {
    Taylor y = f;
    y.value += s;
    return y;
  }
  friend Taylor operator*(const Taylor& f, Given s) {
    Taylor y(f.value * s);
    y.x = f.x * s;
    y.xx = f.xx * s;
    for (std::size_t j = 0; j < n; ++j) {
      y.p[j] = f.p[j] * s;
      y.xp[j] = f.xp[j] * s;
    }
    return y;
  }
  friend Taylor operator+(Given s, const Taylor& f) { return f + s; }
  friend Taylor operator-(const Taylor& f, Given s) { return f + -s; }
  friend Taylor operator-(Given s, const Taylor& f) { return -f + s; }
  friend Taylor operator*(Given s, const Taylor& f) { return f * s; }
  friend Taylor operator/(const Taylor& f, Given s) { return f * (1 / s); }
  friend Taylor operator/(Given s, const Taylor& f) {
    const Number q = 1 / f.value;
    return f.through(s * q, -s * q * q, 2 * s * q * q * q);
  }

  friend bool operator<(const Taylor& f, const Taylor& g) { return f.value < g.value; }
  friend bool operator>(const Taylor& f, const Taylor& g) { return f.value > g.value; }
  friend bool operator<=(const Taylor& f, const Taylor& g) { return f.value <= g.value; }
  friend bool operator>=(const Taylor& f, const Taylor& g) { return f.value >= g.value; }
  friend bool operator==(const Taylor& f, const Taylor& g) { return f.value == g.value; }
  friend bool operator!=(const Taylor& f, const Taylor& g) { return f.value != g.value; }
  friend bool operator<(const Taylor& f, Given s) { return f.value < s; }
  friend bool operator>(const Taylor& f, Given s) { return f.value > s; }
  friend bool operator<=(const Taylor& f, Given s) { return f.value <= s; }
  friend bool operator>=(const Taylor& f, Given s) { return f.value >= s; }
  friend bool operator==(const Taylor& f, Given s) { return f.value == s; }
  friend bool operator!=(const Taylor& f, Given s) { return f.value != s; }
  friend bool operator<(Given s, const Taylor& f) { return s < f.value; }
  friend bool operator>(Given s, const Taylor& f) { return s > f.value; }
  friend bool operator<=(Given s, const Taylor& f) { return s <= f.value; }
  friend bool operator>=(Given s, const Taylor& f) { return s >= f.value; }

  friend Taylor exp(const Taylor& f) {
    using detail::lane_exp;
    const Number e = lane_exp(f.value);
    return f.through(e, e, e);
  }
  friend Taylor expm1(const Taylor& f) {
    using detail::lane_exp;
    using std::expm1;
    const Number e = lane_exp(f.value);
    return f.through(expm1(f.value), e, e);
  }
  friend Taylor log(const Taylor& f) {
    using detail::lane_log;
    const Number q = 1 / f.value;
    return f.through(lane_log(f.value), q, -q * q);
  }
  friend Taylor log1p(const Taylor& f) {
    using std::log1p;
    const Number q = 1 / (1 + f.value);
    return f.through(log1p(f.value), q, -q * q);
  }
  friend Taylor log10(const Taylor& f) {
    using std::log10;
    const Number q = 1 / f.value;
    return f.through(log10(f.value), q * std::numbers::log10e, -q * q * std::numbers::log10e);
  }
  friend Taylor sqrt(const Taylor& f) {
    using std::sqrt;
    const Number r = sqrt(f.value), q = 0.5 / r;
    return f.through(r, q, -0.5 * q / f.value);
  }
  friend Taylor cbrt(const Taylor& f) {
    using std::cbrt;
    const Number r = cbrt(f.value), q = 1 / (3 * r * r);
    return f.through(r, q, -2 * q / (3 * f.value));
  }
  friend Taylor sin(const Taylor& f) {
    using std::sin, std::cos;
    const Number s = sin(f.value), c = cos(f.value);
    return f.through(s, c, -s);
  }
  friend Taylor cos(const Taylor& f) {
    using std::sin, std::cos;
    const Number s = sin(f.value), c = cos(f.value);
    return f.through(c, -s, -c);
  }
  friend Taylor tan(const Taylor& f) {
    using std::tan;
    const Number t = tan(f.value), q = 1 + t * t;
    return f.through(t, q, 2 * t * q);
  }
  friend Taylor asin(const Taylor& f) {
    using std::sqrt, std::asin;
    const Number left = 1 - f.value * f.value, q = 1 / sqrt(left);
    return f.through(asin(f.value), q, f.value * q / left);
  }
  friend Taylor acos(const Taylor& f) {
    using std::sqrt, std::acos;
    const Number left = 1 - f.value * f.value, q = 1 / sqrt(left);
    return f.through(acos(f.value), -q, -f.value * q / left);
  }
  friend Taylor atan(const Taylor& f) {
    using std::atan;
    const Number q = 1 / (1 + f.value * f.value);
    return f.through(atan(f.value), q, -2 * f.value * q * q);
  }
  friend Taylor sinh(const Taylor& f) {
    using std::sinh, std::cosh;
    const Number s = sinh(f.value), c = cosh(f.value);
    return f.through(s, c, s);
  }
  friend Taylor cosh(const Taylor& f) {
    using std::sinh, std::cosh;
    const Number s = sinh(f.value), c = cosh(f.value);
    return f.through(c, s, c);
  }
  friend Taylor tanh(const Taylor& f) {
    using std::tanh;
    const Number t = tanh(f.value), q = 1 - t * t;
    return f.through(t, q, -2 * t * q);
  }
  friend Taylor erf(const Taylor& f) {
    using std::exp, std::erf;
    const Number q = 2 * std::numbers::inv_sqrtpi * exp(-f.value * f.value);
    return f.through(erf(f.value), q, -2 * f.value * q);
  }
  friend Taylor erfc(const Taylor& f) {
    using std::exp, std::erfc;
    const Number q = -2 * std::numbers::inv_sqrtpi * exp(-f.value * f.value);
    return f.through(erfc(f.value), q, -2 * f.value * q);
  }
  friend Taylor abs(const Taylor& f) { return f.value < 0 ? -f : f; }
  friend Taylor min(const Taylor& f, const Taylor& g) { return g.value < f.value ? g : f; }
  friend Taylor max(const Taylor& f, const Taylor& g) { return f.value < g.value ? g : f; }
  friend Taylor min(const Taylor& f, Given s) { return min(f, Taylor(s)); }
  friend Taylor max(const Taylor& f, Given s) { return max(f, Taylor(s)); }
  friend Taylor min(Given s, const Taylor& f) { return min(Taylor(s), f); }
  friend Taylor max(Given s, const Taylor& f) { return max(Taylor(s), f); }
  friend Taylor hypot(const Taylor& f, const Taylor& g) {
    using std::hypot;
    const Number h = hypot(f.value, g.value), a = f.value / h, b = g.value / h;
    return f.through(g, h, a, b, b * b / h, -a * b / h, a * a / h);
  }
  friend Taylor atan2(const Taylor& f, const Taylor& g) {
    using std::atan2;
    const Number q = 1 / (g.value * g.value + f.value * f.value), a = g.value * q, b = f.value * q;
    return f.through(g, atan2(f.value, g.value), a, -b, -2 * a * b, b * b - a * a, 2 * a * b);
  }
  friend Taylor atan2(const Taylor& f, Given s) { return atan2(f, Taylor(s)); }
  friend Taylor atan2(Given s, const Taylor& f) { return atan2(Taylor(s), f); }

  /// The powers 0 and 1 are smooth at f = 0 too.
  friend Taylor pow(const Taylor& f, Given g) {
    using detail::lane_pow;
    if (g == 0) return Taylor(1);
    if (g == 1) return f;
    if (g == 2) return f * f;
    const Number slope = g * lane_pow(f.value, g - 1);
    return f.through(lane_pow(f.value, g), slope, g * (g - 1) * lane_pow(f.value, g - 2));
  }
  /// At f = 0 < g derivatives by g alone are 0, and the mixed one f^(g − 1) (1 + g ln f) is −∞ but for g > 1; at f < 0
  /// they are no numbers.
  friend Taylor pow(const Taylor& f, const Taylor& g) {
    using std::pow, std::log;
    if (g.is_constant()) return pow(f, g.value);
    const Number a = f.value, b = g.value, F = pow(a, b), lower = pow(a, b - 1);
    const bool at_zero = a == 0 && b > 0;
    const Number logarithm = at_zero ? 0 : log(a), at_edge = b > 1 ? 0 : -std::numeric_limits<double>::infinity();
    const Number mixed = at_zero ? at_edge : lower * (1 + b * logarithm);
    const Number twice = b == 1 ? 0 : b * (b - 1) * pow(a, b - 2);
    return f.through(g, F, b * lower, F * logarithm, twice, mixed, F * logarithm * logarithm);
  }
  friend Taylor pow(Given s, const Taylor& g) {
    using std::pow, std::log;
    if (s == 0 && g.value > 0) return Taylor(0);
    const Number F = pow(s, g.value), logarithm = log(s);
    return g.through(F, F * logarithm, F * logarithm * logarithm);
  }
};

}  // namespace tunica
