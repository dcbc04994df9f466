// SPDX-License-Identifier: Apache-2.0
#pragma once

#ifdef __x86_64__
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace tunica::plugins {

/// While it lives, this thread rounds to the nearest number, keeps small ones, calculates with all digits and ends in
/// no exception of floating-point arithmetic; afterwards it does what it did before. The vector functions of the C
/// library (libmvec) err by 1e-3 in every other mode, without a word. A library that was built with -ffast-math leaves
/// another mode behind when it is loaded, and a plugin may do so in any call.
class UsualArithmetic {
 public:
  UsualArithmetic() : before_(mode()) {
    if (before_ != usual) set(usual);
  }
  ~UsualArithmetic() {
    if ((known_ ? usual : mode()) != before_) set(before_);
  }
  UsualArithmetic(const UsualArithmetic&) = delete;
  UsualArithmetic& operator=(const UsualArithmetic&) = delete;

  /// Whether somebody has left another mode behind while it lives; the usual one is back afterwards. The last thing
  /// that it is asked: to look costs ten nanoseconds.
  [[nodiscard]] bool take_change() {
    known_ = true;
    if (mode() == usual) return false;
    set(usual);
    return true;
  }

 private:
  bool known_ = false;  ///< the usual mode is there
#ifdef __x86_64__
  // Of the vector unit rounding, flush to zero, denormals are zero and the masks of its exceptions; the same of the
  // older one, which has long double, and its precision. A mode is the word of the one with that of the other above.
  static constexpr unsigned bits = 0xffc0, older_bits = 0x0f3f, usual = 0x1f80 | 0x033fU << 16;
  static unsigned older() {
    unsigned short word;
    __asm__ volatile("fnstcw %0" : "=m"(word));
    return word;
  }
  static unsigned mode() { return (_mm_getcsr() & bits) | (older() & older_bits) << 16; }
  static void set(unsigned mode) {
    // Exceptions that were raised under a mask would be reported as soon as the mask is gone.
    _mm_setcsr((_mm_getcsr() & ~(bits | raised)) | (mode & bits));
    __asm__ volatile("fnclex");
    const auto word = static_cast<unsigned short>((older() & ~older_bits) | (mode >> 16));
    __asm__ volatile("fldcw %0" : : "m"(word));
  }
  static constexpr unsigned raised = 0x3f;
  unsigned before_;
#else
  static constexpr int usual = FE_TONEAREST;
  static int mode() { return std::fegetround(); }
  static void set(int mode) { std::fesetround(mode); }
  int before_;
#endif
};

/// The message about a plugin that left another floating-point mode behind.
inline constexpr const char* changed_arithmetic =
    "left another mode of floating-point arithmetic behind (rounding, precision, small numbers or traps); expected the "
    "mode that it was called with. Restore it before the call returns";

}  // namespace tunica::plugins
