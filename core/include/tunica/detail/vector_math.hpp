// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "tunica/detail/vector_level.hpp"

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

/// exp and others from glibc's libmvec (part of libm), within 4 units in the last place (glibc manual, "Errors in Math
/// Functions"). In a loop over lanes the compiler takes the function for whole vectors of the loop's level: 1 to 2 ns a
/// value, where std::exp takes 5 to 10. Elsewhere, and with other compilers, they are those of libm.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__)
#define TUNICA_VECTOR_FUNCTION_(function) \
  extern "C"                              \
      [[gnu::simd("notinbranch"), gnu::const, gnu::nothrow]] double tunica_##function##_(double) __asm__(#function)
TUNICA_VECTOR_FUNCTION_(exp);
TUNICA_VECTOR_FUNCTION_(log);
extern "C" [[gnu::simd("notinbranch"), gnu::const, gnu::nothrow]] double tunica_pow_(double, double) __asm__("pow");
#undef TUNICA_VECTOR_FUNCTION_
#define TUNICA_LIBMVEC_ 1
#endif

namespace tunica::detail {

/// e^x, in loops over lanes.
inline double lane_exp(double x) {
#ifdef TUNICA_LIBMVEC_
  return tunica_exp_(x);
#else
  return std::exp(x);
#endif
}
/// ln x, in loops over lanes.
inline double lane_log(double x) {
#ifdef TUNICA_LIBMVEC_
  return tunica_log_(x);
#else
  return std::log(x);
#endif
}

/// x^y, in loops over lanes.
inline double lane_pow(double x, double y) {
#ifdef TUNICA_LIBMVEC_
  return tunica_pow_(x, y);
#else
  return std::pow(x, y);
#endif
}

/// Whether some |x_i| is not below the limit, or no number.
inline bool any_not_below(const double* x, std::size_t n, double limit) {
  bool found = false;
  std::size_t i = 0;
#if defined(__x86_64__)
  const __m128d sign = _mm_set1_pd(-0.0), most = _mm_set1_pd(limit);
  __m128d one = _mm_setzero_pd(), other = one;
  for (; i + 4 <= n; i += 4) {
    one = _mm_or_pd(one, _mm_cmpnlt_pd(_mm_andnot_pd(sign, _mm_loadu_pd(x + i)), most));
    other = _mm_or_pd(other, _mm_cmpnlt_pd(_mm_andnot_pd(sign, _mm_loadu_pd(x + i + 2)), most));
  }
  found = _mm_movemask_pd(_mm_or_pd(one, other)) != 0;
#endif
  for (; i < n; ++i) found |= !(std::abs(x[i]) < limit);
  return found;
}
/// Whether every number is finite: then x − x is 0, and else no number.
inline bool all_finite(const double* x, std::size_t n) {
  bool found = true;
  std::size_t i = 0;
#if defined(__x86_64__)
  __m128d a = _mm_setzero_pd(), b = a, c = a, d = a;
  const auto zero = [](const double* at) {
    const __m128d v = _mm_loadu_pd(at);
    return _mm_sub_pd(v, v);
  };
  for (; i + 8 <= n; i += 8) {
    a = _mm_or_pd(a, zero(x + i));
    b = _mm_or_pd(b, zero(x + i + 2));
    c = _mm_or_pd(c, zero(x + i + 4));
    d = _mm_or_pd(d, zero(x + i + 6));
  }
  const __m128d all = _mm_or_pd(_mm_or_pd(a, b), _mm_or_pd(c, d));
  found = _mm_movemask_pd(_mm_cmpunord_pd(all, all)) == 0;
#endif
  for (; i < n; ++i) found &= x[i] - x[i] == 0;
  return found;
}

}  // namespace tunica::detail
