// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// The cycles of a loading path, from its turning points.
namespace tunica::data {

/// Rows [first, last) over which the load goes one way.
struct Branch {
  std::size_t first = 0, last = 0;
  bool loading = true;    ///< away from rest
  std::size_t cycle = 0;  ///< from 1; 0 = what unloads before the first loading
};

/// The branches of a path, together all its rows. A cycle is a loading and the unloading after it. A turn is one by
/// more than a twentieth of the range of the path, so that noise makes none. The first row of a peak ends the loading,
/// and the last row of a valley begins the next one. Loading goes to the side of `rest` on which the path comes
/// farther.
std::vector<Branch> branches_of(std::span<const double> path, double rest);

/// The number of cycles, whole or begun.
std::size_t cycles_in(const std::vector<Branch>& branches);

/// How often the path goes out and comes back by more than half the way.
std::size_t returns_in(std::span<const double> path, const std::vector<Branch>& branches);

}  // namespace tunica::data
