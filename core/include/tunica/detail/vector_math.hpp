// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

#if defined(__x86_64__) && defined(__GLIBC__)
#include <emmintrin.h>
/// exp of two doubles from glibc's libmvec (part of libm): 2 ns a value with the baseline instruction set, where
/// std::exp takes 5 to 10; within 4 units in the last place (glibc manual, "Errors in Math Functions").
extern "C" __m128d _ZGVbN2v_exp(__m128d);  // NOLINT(bugprone-reserved-identifier): glibc's name
#define TUNICA_LIBMVEC_ 1
#endif

namespace tunica::detail {

/// y_i = exp(x_i), i < n; x and y may be the same. A value does not depend on its place in the batch.
inline void exponential(const double* x, double* y, std::size_t n) {
#ifdef TUNICA_LIBMVEC_
  std::size_t i = 0;
  for (; i + 2 <= n; i += 2) _mm_storeu_pd(y + i, _ZGVbN2v_exp(_mm_loadu_pd(x + i)));
  if (i < n) y[i] = _mm_cvtsd_f64(_ZGVbN2v_exp(_mm_set1_pd(x[i])));
#else
  for (std::size_t i = 0; i < n; ++i) y[i] = std::exp(x[i]);
#endif
}

}  // namespace tunica::detail
