// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

#include "tunica/random.hpp"

namespace tunica::population {

/// Random numbers that are the same with every library; the distributions of <random> are the library's choice.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : generator_(seed) {}
  /// Within (0, 1), without its ends.
  double open() { return (static_cast<double>(generator_() >> 11) + 0.5) * 0x1p-53; }
  /// 0 … count − 1, each as probable, by rejection.
  std::size_t below(std::size_t count) {
    const std::uint64_t limit = UINT64_MAX - UINT64_MAX % count;
    for (;;)
      if (const std::uint64_t drawn = generator_(); drawn < limit) return static_cast<std::size_t>(drawn % count);
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace tunica::population
