// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>

#include "tunica/detail/vector_math.hpp"

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

/// A vector register as a number type, which evaluates a formula at several points at once. A plain loop over lanes
/// would be shorter, but compilers do not vectorise a formula with branches.
///
/// A comparison takes the result of the first lane for all lanes, and notes in `lanes_in_step` which others agree.
/// Results of disagreeing lanes are invalid. The caller sets all bits before it evaluates a formula, and evaluates
/// disagreeing lanes again. The result of a lane therefore does not depend on the values in other lanes.
///
/// Everything is inlined into the kernels of vector_level.hpp, which know the instructions.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"  // nothing here is called: all of it is inlined where the level is known
#endif

namespace tunica::detail {

/// Bit l: lane l has agreed with the first one in all comparisons of this thread.
inline constinit thread_local unsigned lanes_in_step = ~0U;

/// The vector of so many doubles.
template <std::size_t width>
struct VectorOf;
template <>
struct VectorOf<2> {
  using Type = double __attribute__((vector_size(16)));
};
template <>
struct VectorOf<4> {
  using Type = double __attribute__((vector_size(32)));
};
template <>
struct VectorOf<8> {
  using Type = double __attribute__((vector_size(64)));
};

#ifdef TUNICA_LIBMVEC_
// The functions of libmvec by name, each called with the instructions that its vectors are passed in. Their names say
// from which kernels: those alone may hold such instructions, also where a function is not inlined.
#define TUNICA_KERNELS_2_ on_baseline
#define TUNICA_KERNELS_4_ from_run_on_avx2
#define TUNICA_KERNELS_8_ from_run_on_avx512
#define TUNICA_VECTOR_FUNCTION_(function, width, level, instructions, parameters, arguments, ...)                  \
  extern "C" [[gnu::const, gnu::nothrow]] VectorOf<width>::Type tunica_##function##_##width##_ parameters __asm__( \
      "_ZGV" level "_" #function);                                                                                 \
  namespace TUNICA_KERNELS_##width##_ {                                                                            \
    [[gnu::target(instructions)]] inline void function##_of_lanes(VectorOf<width>::Type& z, __VA_ARGS__) {         \
      z = tunica_##function##_##width##_ arguments;                                                                \
    }                                                                                                              \
  }                                                                                                                \
  using TUNICA_KERNELS_##width##_::function##_of_lanes;
#define TUNICA_ONE_(function, width, level, instructions)                                         \
  TUNICA_VECTOR_FUNCTION_(function, width, level "v", instructions, (VectorOf<width>::Type), (x), \
                          const VectorOf<width>::Type& x)
#define TUNICA_TWO_(function, width, level, instructions)                                                            \
  TUNICA_VECTOR_FUNCTION_(function, width, level "vv", instructions, (VectorOf<width>::Type, VectorOf<width>::Type), \
                          (x, y), const VectorOf<width>::Type& x, const VectorOf<width>::Type& y)
TUNICA_ONE_(exp, 2, "bN2", "sse2")
TUNICA_ONE_(exp, 4, "dN4", "avx2")
TUNICA_ONE_(exp, 8, "eN8", "avx512f")
TUNICA_ONE_(log, 2, "bN2", "sse2")
TUNICA_ONE_(log, 4, "dN4", "avx2")
TUNICA_ONE_(log, 8, "eN8", "avx512f")
TUNICA_TWO_(pow, 2, "bN2", "sse2")
TUNICA_TWO_(pow, 4, "dN4", "avx2")
TUNICA_TWO_(pow, 8, "eN8", "avx512f")
#undef TUNICA_TWO_
#undef TUNICA_ONE_
#undef TUNICA_VECTOR_FUNCTION_
#undef TUNICA_KERNELS_8_
#undef TUNICA_KERNELS_4_
#undef TUNICA_KERNELS_2_
#endif

/// `width` numbers in one register: 2, 4 or 8.
template <std::size_t width>
struct Lanes {
  using Vector = typename VectorOf<width>::Type;
  Vector v;

  [[gnu::always_inline]] Lanes() : v{} {}
  /// The same number in every lane. Eight come from an array, of which the compiler makes one broadcast: an operation
  /// on vectors that wide it takes apart before it knows the level, and writes lane by lane. Narrower ones it leaves
  /// whole, and keeps better in registers.
  [[gnu::always_inline]] Lanes(double x) {
    if constexpr (width == 8) {
      double same[width];
      for (std::size_t l = 0; l < width; ++l) same[l] = x;
      std::memcpy(&v, same, sizeof v);
    } else {
      v = x - Vector{};
    }
  }
  [[gnu::always_inline]] explicit Lanes(const Vector& x) : v(x) {}
  // Written out, so that what holds lanes is copied vector by vector, and not as a block of memory.
  [[gnu::always_inline]] Lanes(const Lanes& x) : v(x.v) {}
  [[gnu::always_inline]] Lanes& operator=(const Lanes& x) {
    v = x.v;
    return *this;
  }
  [[gnu::always_inline]] static Lanes load(const double* from) {
    Lanes x;
    std::memcpy(&x.v, from, sizeof x.v);
    return x;
  }
  [[gnu::always_inline]] void store(double* to) const { std::memcpy(to, &v, sizeof v); }

#define TUNICA_OPERATOR_(op)                                                                                    \
  [[gnu::always_inline]] friend Lanes operator op(const Lanes& a, const Lanes& b) { return Lanes(a.v op b.v); } \
  [[gnu::always_inline]] Lanes& operator op##=(const Lanes& b) { return *this = *this op b; }
  TUNICA_OPERATOR_(+)
  TUNICA_OPERATOR_(-)
  TUNICA_OPERATOR_(*)
  TUNICA_OPERATOR_(/)
#undef TUNICA_OPERATOR_
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a) { return Lanes(-a.v); }

#define TUNICA_COMPARISON_(op) \
  [[gnu::always_inline]] friend bool operator op(const Lanes& a, const Lanes& b) { return decided(a.v op b.v); }
  TUNICA_COMPARISON_(<)
  TUNICA_COMPARISON_(>)
  TUNICA_COMPARISON_(<=)
  TUNICA_COMPARISON_(>=)
  TUNICA_COMPARISON_(==)
  TUNICA_COMPARISON_(!=)
#undef TUNICA_COMPARISON_

#define TUNICA_FUNCTION_(function)                                          \
  [[gnu::always_inline]] friend Lanes function(const Lanes& x) {            \
    Lanes y;                                                                \
    for (std::size_t l = 0; l < width; ++l) y.v[l] = std::function(x.v[l]); \
    return y;                                                               \
  }
  TUNICA_FUNCTION_(acos)
  TUNICA_FUNCTION_(asin)
  TUNICA_FUNCTION_(atan)
  TUNICA_FUNCTION_(cbrt)
  TUNICA_FUNCTION_(cos)
  TUNICA_FUNCTION_(cosh)
  TUNICA_FUNCTION_(erf)
  TUNICA_FUNCTION_(erfc)
  TUNICA_FUNCTION_(expm1)
  TUNICA_FUNCTION_(log10)
  TUNICA_FUNCTION_(log1p)
  TUNICA_FUNCTION_(sin)
  TUNICA_FUNCTION_(sinh)
  TUNICA_FUNCTION_(sqrt)
  TUNICA_FUNCTION_(tan)
  TUNICA_FUNCTION_(tanh)
#ifndef TUNICA_LIBMVEC_
  TUNICA_FUNCTION_(exp)
  TUNICA_FUNCTION_(log)
#endif
#undef TUNICA_FUNCTION_
#define TUNICA_FUNCTION_(function)                                                  \
  [[gnu::always_inline]] friend Lanes function(const Lanes& x, const Lanes& y) {    \
    Lanes z;                                                                        \
    for (std::size_t l = 0; l < width; ++l) z.v[l] = std::function(x.v[l], y.v[l]); \
    return z;                                                                       \
  }
  TUNICA_FUNCTION_(atan2)
  TUNICA_FUNCTION_(hypot)
#ifndef TUNICA_LIBMVEC_
  TUNICA_FUNCTION_(pow)
#endif
#undef TUNICA_FUNCTION_

#ifdef TUNICA_LIBMVEC_
  [[gnu::always_inline]] friend Lanes exp(const Lanes& x) {
    Lanes y;
    exp_of_lanes(y.v, x.v);
    return y;
  }
  [[gnu::always_inline]] friend Lanes log(const Lanes& x) {
    Lanes y;
    log_of_lanes(y.v, x.v);
    return y;
  }
  [[gnu::always_inline]] friend Lanes pow(const Lanes& x, const Lanes& y) {
    Lanes z;
    pow_of_lanes(z.v, x.v, y.v);
    return z;
  }
#endif
  [[gnu::always_inline]] friend Lanes lane_exp(const Lanes& x) { return exp(x); }
  [[gnu::always_inline]] friend Lanes lane_log(const Lanes& x) { return log(x); }
  [[gnu::always_inline]] friend Lanes lane_pow(const Lanes& x, const Lanes& y) { return pow(x, y); }

 private:
  /// Bit l: it is true in lane l.
  template <class Mask>
  [[gnu::always_inline]] static unsigned bits(const Mask& lanes) {
    unsigned found = 0;
#if defined(__x86_64__)
    for (std::size_t l = 0; l < width; l += 2) {
      __m128d two;
      std::memcpy(&two, reinterpret_cast<const char*>(&lanes) + l * sizeof(double), sizeof two);
      found |= static_cast<unsigned>(_mm_movemask_pd(two)) << l;
    }
#else
    for (std::size_t l = 0; l < width; ++l) found |= static_cast<unsigned>(lanes[l] != 0) << l;
#endif
    return found;
  }
  template <class Mask>
  [[gnu::always_inline]] static bool decided(const Mask& lanes) {
    const unsigned found = bits(lanes);
    const bool first = (found & 1) != 0;
    lanes_in_step &= first ? found : ~found;
    return first;
  }
};

}  // namespace tunica::detail

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
