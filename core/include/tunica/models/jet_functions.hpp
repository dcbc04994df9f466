// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <type_traits>

#include <ceres/jet.h>

/// What Ceres leaves out of the arithmetic of jets: plain numbers beside jets of jets, whole numbers beside any jet,
/// and powers of jets of jets.
///
/// A jet of jets carries second derivatives: its value and its derivatives are jets themselves. Formulas of energies
/// are evaluated with them (autodiff.hpp). tunica::functions below lists what a formula may call.
namespace ceres {

/// A plain number beside a jet over T, for which Ceres has no operator.
template <class S, class T>
concept PlainBeside = std::is_arithmetic_v<S> && !std::is_same_v<S, T>;

/// A number as a jet without derivatives, or as a number.
template <class T>
T jet_constant(double value) {
  if constexpr (internal::IsJet_v<T>)
    return T(jet_constant<typename T::Scalar>(value));
  else
    return static_cast<T>(value);
}

/// Whether no derivative, of whatever order, differs from zero.
template <class T>
bool is_jet_constant(const T& f) {
  if constexpr (internal::IsJet_v<T>) {
    for (int i = 0; i < T::DIMENSION; ++i)
      if (f.v[i] != 0 || !is_jet_constant(f.v[i])) return false;
    return is_jet_constant(f.a);
  } else {
    return true;
  }
}

#define TUNICA_BESIDE_(op)                                                                              \
  template <class S, class T, int N>                                                                    \
  requires PlainBeside<S, T> Jet<T, N>                                                                  \
  operator op(S s, const Jet<T, N>& f) { return jet_constant<Jet<T, N>>(static_cast<double>(s)) op f; } \
  template <class S, class T, int N>                                                                    \
  requires PlainBeside<S, T> Jet<T, N>                                                                  \
  operator op(const Jet<T, N>& f, S s) { return f op jet_constant<Jet<T, N>>(static_cast<double>(s)); } \
  template <class S, class T, int N>                                                                    \
  requires(PlainBeside<S, T> && internal::IsJet_v<T>) Jet<T, N>                                         \
  &operator op##=(Jet<T, N>& f, S s) { return f op## = jet_constant<Jet<T, N>>(static_cast<double>(s)); }
TUNICA_BESIDE_(+)
TUNICA_BESIDE_(-)
TUNICA_BESIDE_(*)
TUNICA_BESIDE_(/)
#undef TUNICA_BESIDE_

/// |f|; of two slopes at zero the right one.
template <class T, int N>
requires internal::IsJet_v<T> Jet<T, N> abs(const Jet<T, N>& f) { return f < 0 ? -f : f; }

/// f^g with a number g. The powers 0 and 1 are smooth at f = 0 too.
template <class T, int N>
requires(std::is_arithmetic_v<T> || internal::IsJet_v<T>) Jet<T, N> pow(const Jet<T, N>& f, double g) {
  if (g == 0) return jet_constant<Jet<T, N>>(1);
  if (g == 1) return f;
  const T slope = g * pow(f.a, g - 1.0);
  return Jet<T, N>(pow(f.a, g), slope * f.v);
}

/// f^g with d(f^g) = g f^(g−1) df + f^g ln f dg.
///
/// At f = 0 the second term has the limit 0 while g > 0. At f < 0 it is no number: a whole power has derivatives by f
/// there, and none by g.
template <class T, int N>
requires internal::IsJet_v<T> Jet<T, N> pow(const Jet<T, N>& f, const Jet<T, N>& g) {
  if (is_jet_constant(g)) return pow(f, static_cast<double>(internal::AsScalar(g)));
  if (f == 0 && g == 1) return f;
  const T value = pow(f.a, g.a), slope = g.a * pow(f.a, g.a - 1.0);
  Jet<T, N> power(value, slope * f.v);
  bool moves = false;
  for (int i = 0; i < N; ++i) moves |= g.v[i] != 0 || !is_jet_constant(g.v[i]);
  if (moves && !(f == 0 && g > 0)) power.v += value * log(f.a) * g.v;
  return power;
}

/// s^g with a number s, and whole s where Ceres has it for a double.
template <class S, class T, int N>
requires PlainBeside<S, T> Jet<T, N> pow(S s, const Jet<T, N>& g) {
  const double base = static_cast<double>(s);
  if constexpr (!internal::IsJet_v<T>) {
    return pow(static_cast<T>(base), g);
  } else {
    if (base == 0 && g > 0) return jet_constant<Jet<T, N>>(0);
    const T value = pow(base, g.a);
    return Jet<T, N>(value, std::log(base) * value * g.v);
  }
}

/// The angle of the point (x, y); one of the two may be a number.
template <class S, class T, int N>
requires std::is_arithmetic_v<S> Jet<T, N> atan2(const Jet<T, N>& y, S x) {
  return atan2(y, jet_constant<Jet<T, N>>(static_cast<double>(x)));
}
/// The same with a number y.
template <class S, class T, int N>
requires std::is_arithmetic_v<S> Jet<T, N> atan2(S y, const Jet<T, N>& x) {
  return atan2(jet_constant<Jet<T, N>>(static_cast<double>(y)), x);
}

/// The smaller one, with its derivatives; the first of two that are equal, as std::min.
template <class T, int N>
Jet<T, N> min(const Jet<T, N>& f, const Jet<T, N>& g) {
  return g < f ? g : f;
}
/// The same with a number.
template <class S, class T, int N>
requires std::is_arithmetic_v<S> Jet<T, N> min(const Jet<T, N>& f, S s) {
  return min(f, jet_constant<Jet<T, N>>(static_cast<double>(s)));
}
/// The same with a number.
template <class S, class T, int N>
requires std::is_arithmetic_v<S> Jet<T, N> min(S s, const Jet<T, N>& f) {
  return min(jet_constant<Jet<T, N>>(static_cast<double>(s)), f);
}
/// The larger one, with its derivatives; the first of two that are equal, as std::max.
template <class T, int N>
Jet<T, N> max(const Jet<T, N>& f, const Jet<T, N>& g) {
  return f < g ? g : f;
}
/// The same with a number.
template <class S, class T, int N>
requires std::is_arithmetic_v<S> Jet<T, N> max(const Jet<T, N>& f, S s) {
  return max(f, jet_constant<Jet<T, N>>(static_cast<double>(s)));
}
/// The same with a number.
template <class S, class T, int N>
requires std::is_arithmetic_v<S> Jet<T, N> max(S s, const Jet<T, N>& f) {
  return max(jet_constant<Jet<T, N>>(static_cast<double>(s)), f);
}

}  // namespace ceres

/// What the formula of an energy may call, for numbers, jets and jets of jets alike.
///
///     using namespace tunica::functions;
///     return p[0] * (pow(x, p[1]) + exp(-x) - 1.0);
///
/// Besides these, + − * / += −= *= /= and < <= > >= == != take jets and numbers in any order. docs/sdk.md has the list.
namespace tunica::functions {
using ceres::abs;
using ceres::acos;
using ceres::asin;
using ceres::atan;
using ceres::atan2;
using ceres::cbrt;
using ceres::cos;
using ceres::cosh;
using ceres::erf;
using ceres::erfc;
using ceres::exp;
using ceres::expm1;
using ceres::hypot;
using ceres::log;
using ceres::log10;
using ceres::log1p;
using ceres::max;
using ceres::min;
using ceres::pow;
using ceres::sin;
using ceres::sinh;
using ceres::sqrt;
using ceres::tan;
using ceres::tanh;
using std::max;
using std::min;
}  // namespace tunica::functions
