// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

/// Marks in the outputs of a plugin: a mark that remains after a call shows an unwritten value.
namespace tunica::plugins {

/// A NaN that no arithmetic makes.
constexpr double unwritten = std::bit_cast<double>(std::uint64_t{0x7ff8'dead'0000'0000});

inline bool is_unwritten(double value) {
  return std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(unwritten);
}

/// Marks the first and the last of every n numbers. A plugin that omits a component omits all of its numbers: to mark
/// those too would cost as much as a model. `tunica plugin check` does.
inline void mark_ends(std::span<double> values, std::size_t n) {
  for (std::size_t first = 0; first < values.size(); first += n) values[first] = values[first + n - 1] = unwritten;
}

/// Whether a mark is left at an end. `n` divides the size.
inline bool has_marked_ends(std::span<const double> values, std::size_t n) {
  for (std::size_t first = 0; first < values.size(); first += n)
    if (is_unwritten(values[first]) || is_unwritten(values[first + n - 1])) return true;
  return false;
}

}  // namespace tunica::plugins
