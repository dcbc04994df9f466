// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <type_traits>

#include "tunica/detail/vector_math.hpp"

namespace tunica {

/// A number w(x; p) with the derivatives that a response asks for: by x once and twice, by each of n parameters, and by
/// x and a parameter. The arithmetic of a law's formula on it is that of numbers and the chain rule,
///
///     f(w)_x = f' w_x,   f(w)_xx = f' w_xx + f'' w_x²,   f(w)_p = f' w_p,   f(w)_xp = f' w_xp + f'' w_x w_p.
///
/// It holds nothing else and no vectors of a library, so that a loop over points becomes one over lanes. A formula may
/// call what tunica::functions (jet_functions.hpp) lists.
template <std::size_t n>
struct Taylor {
  double value = 0,                 ///< w
      x = 0,                        ///< ∂w/∂x
      xx = 0;                       ///< ∂²w/∂x²
  std::array<double, n> p{}, xp{};  ///< ∂w/∂p_j, ∂²w/∂x∂p_j

  Taylor() = default;
  /// A number without derivatives.
  explicit Taylor(double number) : value(number) {}

  /// The argument of the law.
  static Taylor argument(double at) {
    Taylor w(at);
    w.x = 1;
    return w;
  }
  /// Parameter j.
  static Taylor parameter(double at, [[maybe_unused]] std::size_t j) {
    Taylor w(at);
    if constexpr (n > 0) w.p[j] = 1;
    return w;
  }

  /// f(w) from f, f' and f''.
  [[nodiscard]] Taylor through(double f, double f1, double f2) const {
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
  [[nodiscard]] Taylor through(const Taylor& g, double F, double Fw, double Fg, double Fww, double Fwg,
                               double Fgg) const {
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
  Taylor& operator+=(double s) {
    value += s;
    return *this;
  }
  Taylor& operator-=(double s) {
    value -= s;
    return *this;
  }
  Taylor& operator*=(double s) { return *this = *this * s; }
  Taylor& operator/=(double s) { return *this = *this / s; }

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
    const double q = 1 / g.value;
    return f * g.through(q, -q * q, 2 * q * q * q);
  }
  friend Taylor operator+(const Taylor& f, double s) {
    Taylor y = f;
    y.value += s;
    return y;
  }
  friend Taylor operator*(const Taylor& f, double s) {
    Taylor y(f.value * s);
    y.x = f.x * s;
    y.xx = f.xx * s;
    for (std::size_t j = 0; j < n; ++j) {
      y.p[j] = f.p[j] * s;
      y.xp[j] = f.xp[j] * s;
    }
    return y;
  }
  friend Taylor operator+(double s, const Taylor& f) { return f + s; }
  friend Taylor operator-(const Taylor& f, double s) { return f + -s; }
  friend Taylor operator-(double s, const Taylor& f) { return -f + s; }
  friend Taylor operator*(double s, const Taylor& f) { return f * s; }
  friend Taylor operator/(const Taylor& f, double s) { return f * (1 / s); }
  friend Taylor operator/(double s, const Taylor& f) {
    const double q = 1 / f.value;
    return f.through(s * q, -s * q * q, 2 * s * q * q * q);
  }

  friend bool operator<(const Taylor& f, const Taylor& g) { return f.value < g.value; }
  friend bool operator>(const Taylor& f, const Taylor& g) { return f.value > g.value; }
  friend bool operator<=(const Taylor& f, const Taylor& g) { return f.value <= g.value; }
  friend bool operator>=(const Taylor& f, const Taylor& g) { return f.value >= g.value; }
  friend bool operator==(const Taylor& f, const Taylor& g) { return f.value == g.value; }
  friend bool operator!=(const Taylor& f, const Taylor& g) { return f.value != g.value; }
  friend bool operator<(const Taylor& f, double s) { return f.value < s; }
  friend bool operator>(const Taylor& f, double s) { return f.value > s; }
  friend bool operator<=(const Taylor& f, double s) { return f.value <= s; }
  friend bool operator>=(const Taylor& f, double s) { return f.value >= s; }
  friend bool operator==(const Taylor& f, double s) { return f.value == s; }
  friend bool operator!=(const Taylor& f, double s) { return f.value != s; }
  friend bool operator<(double s, const Taylor& f) { return s < f.value; }
  friend bool operator>(double s, const Taylor& f) { return s > f.value; }
  friend bool operator<=(double s, const Taylor& f) { return s <= f.value; }
  friend bool operator>=(double s, const Taylor& f) { return s >= f.value; }

  friend Taylor exp(const Taylor& f) {
    const double e = detail::lane_exp(f.value);
    return f.through(e, e, e);
  }
  friend Taylor expm1(const Taylor& f) {
    const double e = detail::lane_exp(f.value);
    return f.through(std::expm1(f.value), e, e);
  }
  friend Taylor log(const Taylor& f) {
    const double q = 1 / f.value;
    return f.through(detail::lane_log(f.value), q, -q * q);
  }
  friend Taylor log1p(const Taylor& f) {
    const double q = 1 / (1 + f.value);
    return f.through(std::log1p(f.value), q, -q * q);
  }
  friend Taylor log10(const Taylor& f) {
    const double q = 1 / f.value;
    return f.through(std::log10(f.value), q * std::numbers::log10e, -q * q * std::numbers::log10e);
  }
  friend Taylor sqrt(const Taylor& f) {
    const double r = std::sqrt(f.value), q = 0.5 / r;
    return f.through(r, q, -0.5 * q / f.value);
  }
  friend Taylor cbrt(const Taylor& f) {
    const double r = std::cbrt(f.value), q = 1 / (3 * r * r);
    return f.through(r, q, -2 * q / (3 * f.value));
  }
  friend Taylor sin(const Taylor& f) {
    const double s = std::sin(f.value), c = std::cos(f.value);
    return f.through(s, c, -s);
  }
  friend Taylor cos(const Taylor& f) {
    const double s = std::sin(f.value), c = std::cos(f.value);
    return f.through(c, -s, -c);
  }
  friend Taylor tan(const Taylor& f) {
    const double t = std::tan(f.value), q = 1 + t * t;
    return f.through(t, q, 2 * t * q);
  }
  friend Taylor asin(const Taylor& f) {
    const double left = 1 - f.value * f.value, q = 1 / std::sqrt(left);
    return f.through(std::asin(f.value), q, f.value * q / left);
  }
  friend Taylor acos(const Taylor& f) {
    const double left = 1 - f.value * f.value, q = 1 / std::sqrt(left);
    return f.through(std::acos(f.value), -q, -f.value * q / left);
  }
  friend Taylor atan(const Taylor& f) {
    const double q = 1 / (1 + f.value * f.value);
    return f.through(std::atan(f.value), q, -2 * f.value * q * q);
  }
  friend Taylor sinh(const Taylor& f) {
    const double s = std::sinh(f.value), c = std::cosh(f.value);
    return f.through(s, c, s);
  }
  friend Taylor cosh(const Taylor& f) {
    const double s = std::sinh(f.value), c = std::cosh(f.value);
    return f.through(c, s, c);
  }
  friend Taylor tanh(const Taylor& f) {
    const double t = std::tanh(f.value), q = 1 - t * t;
    return f.through(t, q, -2 * t * q);
  }
  friend Taylor erf(const Taylor& f) {
    const double q = 2 * std::numbers::inv_sqrtpi * std::exp(-f.value * f.value);
    return f.through(std::erf(f.value), q, -2 * f.value * q);
  }
  friend Taylor erfc(const Taylor& f) {
    const double q = -2 * std::numbers::inv_sqrtpi * std::exp(-f.value * f.value);
    return f.through(std::erfc(f.value), q, -2 * f.value * q);
  }
  friend Taylor abs(const Taylor& f) { return f.value < 0 ? -f : f; }
  friend Taylor min(const Taylor& f, const Taylor& g) { return g.value < f.value ? g : f; }
  friend Taylor max(const Taylor& f, const Taylor& g) { return f.value < g.value ? g : f; }
  friend Taylor min(const Taylor& f, double s) { return min(f, Taylor(s)); }
  friend Taylor max(const Taylor& f, double s) { return max(f, Taylor(s)); }
  friend Taylor min(double s, const Taylor& f) { return min(Taylor(s), f); }
  friend Taylor max(double s, const Taylor& f) { return max(Taylor(s), f); }
  friend Taylor hypot(const Taylor& f, const Taylor& g) {
    const double h = std::hypot(f.value, g.value), a = f.value / h, b = g.value / h;
    return f.through(g, h, a, b, b * b / h, -a * b / h, a * a / h);
  }
  friend Taylor atan2(const Taylor& y, const Taylor& x) {
    const double q = 1 / (x.value * x.value + y.value * y.value), a = x.value * q, b = y.value * q;
    return y.through(x, std::atan2(y.value, x.value), a, -b, -2 * a * b, b * b - a * a, 2 * a * b);
  }
  friend Taylor atan2(const Taylor& y, double x) { return atan2(y, Taylor(x)); }
  friend Taylor atan2(double y, const Taylor& x) { return atan2(Taylor(y), x); }

  /// The powers 0 and 1 are smooth at f = 0 too.
  friend Taylor pow(const Taylor& f, double g) {
    if (g == 0) return Taylor(1);
    if (g == 1) return f;
    if (g == 2) return f * f;
    const double slope = g * detail::lane_pow(f.value, g - 1);
    return f.through(detail::lane_pow(f.value, g), slope, g * (g - 1) * detail::lane_pow(f.value, g - 2));
  }
  /// At f = 0 < g all derivatives by g are 0; at f < 0 they are no numbers.
  friend Taylor pow(const Taylor& f, const Taylor& g) {
    if (g.is_constant()) return pow(f, g.value);
    const double a = f.value, b = g.value, F = std::pow(a, b), lower = std::pow(a, b - 1);
    const bool at_zero = a == 0 && b > 0;
    const double logarithm = at_zero ? 0 : std::log(a), mixed = at_zero && b > 1 ? 0 : lower * (1 + b * logarithm);
    const double twice = b == 1 ? 0 : b * (b - 1) * std::pow(a, b - 2);
    return f.through(g, F, b * lower, F * logarithm, twice, mixed, F * logarithm * logarithm);
  }
  friend Taylor pow(double s, const Taylor& g) {
    if (s == 0 && g.value > 0) return Taylor(0);
    const double F = std::pow(s, g.value), logarithm = std::log(s);
    return g.through(F, F * logarithm, F * logarithm * logarithm);
  }
};

}  // namespace tunica
