// SPDX-License-Identifier: Apache-2.0
#pragma once

#ifdef __x86_64__
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
#ifdef __x86_64__
  // Rounding, flush to zero and denormals are zero of the vector unit; rounding of the older one, which has long
  // double.
  static constexpr unsigned usual = 0, bits = 0xe040, older_bits = 0x0c00;
  static unsigned older() {
    unsigned short word;
    __asm__ volatile("fnstcw %0" : "=m"(word));
    return word;
  }
  static unsigned mode() { return (_mm_getcsr() & bits) | (older() & older_bits) << 16; }
  static void set(unsigned mode) {
    _mm_setcsr((_mm_getcsr() & ~bits) | (mode & bits));
    const auto word = static_cast<unsigned short>((older() & ~older_bits) | (mode >> 16));
    __asm__ volatile("fldcw %0" : : "m"(word));
  }
  unsigned before_;
#else
  static constexpr int usual = FE_TONEAREST;
  static int mode() { return std::fegetround(); }
  static void set(int mode) { std::fesetround(mode); }
  int before_;
#endif
};

}  // namespace tunica::plugins
