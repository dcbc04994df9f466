// SPDX-License-Identifier: Apache-2.0
// What an instrumented source calls: each function carries the number of its first mutant, and behaves as the original
// unless TUNICA_MUTANT names one of its mutants. TUNICA_MUTANT=reach writes the number of every mutant that is reached
// to the file TUNICA_MUTANT_REACH instead. Operands are evaluated once; the lazy operators are rewritten around theirs.
#pragma once
#pragma GCC system_header
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

namespace tunica_mutant {

/// The active mutant; 0: none; -1: reached mutants are recorded.
inline int chosen() {
  const char* const text = std::getenv("TUNICA_MUTANT");
  if (!text) return 0;
  return std::strcmp(text, "reach") == 0 ? -1 : std::atoi(text);
}
inline const int alive = chosen();

/// Writes the numbers `first` .. `first + count - 1` once. Threads may come here at the same time.
inline bool reached(int first, int count) {
  static std::atomic<int> seen[1 << 16];
  for (std::uint32_t place = static_cast<std::uint32_t>(first) * 2654435761u >> 16;; place = (place + 1) & 0xffff) {
    int expected = 0;
    if (seen[place].load(std::memory_order_relaxed) == first) return false;
    if (!seen[place].compare_exchange_strong(expected, first)) {
      if (expected == first) return false;
      continue;
    }
    static const int file = open(std::getenv("TUNICA_MUTANT_REACH"), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    char text[16];
    for (int k = 0; k < count; ++k) {
      const int length = std::snprintf(text, sizeof text, "%d\n", first + k);
      if (write(file, text, static_cast<std::size_t>(length)) != length) std::abort();
    }
    return false;
  }
}

inline bool is(int mutant, int count = 1) {
  if (alive == 0) [[likely]]
    return false;
  return alive == mutant || (alive < 0 && reached(mutant, count));
}

/// The second of two mutants at one place; the first has written both down.
inline bool also(int mutant) { return alive == mutant; }

template <class A, class B>
auto add(int k, A a, B b) {
  return is(k) ? a - b : a + b;
}
template <class A, class B>
auto subtract(int k, A a, B b) {
  return is(k) ? a + b : a - b;
}
template <class A, class B>
auto multiply(int k, A a, B b) {
  return is(k) ? a / b : a * b;
}
template <class A, class B>
auto divide(int k, A a, B b) {
  return is(k) ? a * b : a / b;
}
template <class A, class B>
auto remainder(int k, A a, B b) {
  return is(k) ? a * b : a % b;
}

template <class A, class B>
bool less(int k, A a, B b) {
  return is(k) ? a >= b : a < b;
}
template <class A, class B>
bool greater(int k, A a, B b) {
  return is(k) ? a <= b : a > b;
}
template <class A, class B>
bool at_most(int k, A a, B b) {
  return is(k) ? a > b : a <= b;
}
template <class A, class B>
bool at_least(int k, A a, B b) {
  return is(k) ? a < b : a >= b;
}
template <class A, class B>
bool equal(int k, A a, B b) {
  return is(k) ? a != b : a == b;
}
template <class A, class B>
bool differs(int k, A a, B b) {
  return is(k) ? a == b : a != b;
}
// Whole numbers: one too many or too few as well.
template <class A, class B>
bool less_whole(int k, A a, B b) {
  return is(k, 2) ? a >= b : also(k + 1) ? a <= b : a < b;
}
template <class A, class B>
bool greater_whole(int k, A a, B b) {
  return is(k, 2) ? a <= b : also(k + 1) ? a >= b : a > b;
}
template <class A, class B>
bool at_most_whole(int k, A a, B b) {
  return is(k, 2) ? a > b : also(k + 1) ? a < b : a <= b;
}
template <class A, class B>
bool at_least_whole(int k, A a, B b) {
  return is(k, 2) ? a < b : also(k + 1) ? a > b : a >= b;
}

template <class A, class B>
A& add_to(int k, A& a, B b) {
  return is(k) ? a -= b : a += b;
}
template <class A, class B>
A& subtract_from(int k, A& a, B b) {
  return is(k) ? a += b : a -= b;
}
template <class A, class B>
A& multiply_by(int k, A& a, B b) {
  return is(k) ? a /= b : a *= b;
}
template <class A, class B>
A& divide_by(int k, A& a, B b) {
  return is(k) ? a *= b : a /= b;
}

template <class A>
auto negative(int k, A a) {
  return is(k) ? +a : -a;
}
inline bool negation(int k, bool a) { return is(k) ? a : !a; }
inline bool condition(int k, bool a) { return is(k) ? !a : a; }

/// A whole number: one more. With two mutants, one less too.
template <class T>
T whole(int k, T value) {
  return is(k) ? static_cast<T>(value + 1) : value;
}
template <class T>
T whole_from_one(int k, T value) {
  return is(k, 2) ? static_cast<T>(value + 1) : also(k + 1) ? static_cast<T>(value - 1) : value;
}
/// A real number: doubled; 0 becomes 1, and what is so small that it is a tolerance, a million times as large.
template <class T>
T real(int k, T value) {
  if (!is(k)) return value;
  return value == 0 ? T(1) : value > T(-1e-5) && value < T(1e-5) ? value * T(1e6) : value * T(2);
}

}  // namespace tunica_mutant
