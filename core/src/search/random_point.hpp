// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "tunica/random.hpp"

namespace tunica::search {

/// Uniform in the unit box of n dimensions; the same for every optimiser of the same seed.
inline std::vector<double> random_point(std::uint64_t seed, std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t j = 0; j < n; ++j)
    x[j] = static_cast<double>(derive_seed(seed, fmt::format("initial {}", j)) >> 11) * 0x1p-53;
  return x;
}

}  // namespace tunica::search
