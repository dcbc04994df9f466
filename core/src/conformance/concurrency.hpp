// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace tunica::conformance {

/// The outcome of threads that made the same calls in parallel.
struct Race {
  bool lost = false;      ///< some call answered otherwise than alone
  std::size_t input = 0;  ///< which
  std::uint64_t calls = 0;
  std::size_t threads = 0;
};

/// Threads that go through the inputs 0 … count − 1 over and over, each in an order of its own, until one of
/// `agrees(input)` is false, but for at least `seconds` and a round each. More threads than processors, and an
/// alarm that puts one of them to sleep every 70 µs wherever it is: so calls are interleaved on one processor too. What
/// a call throws is thrown here.
Race race_threads(std::size_t count, const std::function<bool(std::size_t)>& agrees, double seconds = 0.4);

}  // namespace tunica::conformance
