// SPDX-License-Identifier: Apache-2.0
#pragma once

#ifdef __SSE2__
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace tunica::plugins {

/// While it lives, this thread rounds to the nearest number and keeps small ones; afterwards it does what it did
/// before. The vector functions of the C library (libmvec) err by 1e-3 in every other mode, without a word. A library
/// that was built with -ffast-math leaves another mode behind when it is loaded, and a plugin may do so in any call.
class UsualArithmetic {
 public:
  UsualArithmetic() : before_(mode()) {
    if (before_ != usual) set(usual);
  }
  ~UsualArithmetic() {
    if (mode() != before_) set(before_);
  }
  UsualArithmetic(const UsualArithmetic&) = delete;
  UsualArithmetic& operator=(const UsualArithmetic&) = delete;

 private:
#ifdef __SSE2__
  static constexpr unsigned usual = 0, bits = 0xe040;  // rounding, flush to zero, denormals are zero
  static unsigned mode() { return _mm_getcsr() & bits; }
  static void set(unsigned mode) { _mm_setcsr((_mm_getcsr() & ~bits) | mode); }
  unsigned before_;
#else
  static constexpr int usual = FE_TONEAREST;
  static int mode() { return std::fegetround(); }
  static void set(int mode) { std::fesetround(mode); }
  int before_;
#endif
};

}  // namespace tunica::plugins
