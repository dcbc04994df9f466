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
/// `agrees(input)` is false, but for at least a round each and `seconds` of every processor, and at most for twenty
/// times as long. There are more threads than processors. An alarm puts one of them to sleep every 70 µs, wherever it
/// is, until others have made calls. So calls are interleaved on one processor too, and on a busy one. What a call
/// throws is thrown here.
Race race_threads(std::size_t count, const std::function<bool(std::size_t)>& agrees, double seconds = 0.6);

}  // namespace tunica::conformance
