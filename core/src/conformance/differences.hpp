// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace tunica::conformance {

/// A derivative by differences, and how far it may be off.
struct Difference {
  double value = 0, uncertainty = std::numeric_limits<double>::infinity();
};

/// df/dt at t = 0 of a function with several values, by central differences with steps h, h/4, …, h/256 and
/// Richardson's extrapolation of each neighbouring two (Ridders 1982, Adv. Eng. Software 4:75): of the estimates that
/// one that agrees best with the one before. Steep functions, kinks nearby and rounding show in the uncertainty instead
/// of being blamed on who is checked, and so does half of the difference of the two slopes of a kink at t = 0, of which
/// central differences know only the mean. Values that are no numbers at a step leave that step out.
template <class Function>
std::vector<Difference> differentiate(const Function& f, double h) {
  constexpr std::size_t levels = 5;
  const std::vector<double> at = f(0.0);
  std::array<std::vector<double>, levels> central, bend;
  std::array<double, levels> step{};
  std::vector<double> size;
  for (std::size_t k = 0; k < levels; ++k, h /= 4) {
    step[k] = h;
    const std::vector<double> up = f(h), down = f(-h);
    size.resize(up.size());
    for (std::size_t i = 0; i < up.size(); ++i) {
      central[k].push_back((up[i] - down[i]) / (2 * h));
      bend[k].push_back((up[i] - 2 * at[i] + down[i]) / h);
      if (std::abs(up[i]) > size[i]) size[i] = std::abs(up[i]);
    }
  }
  std::vector<Difference> found(size.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k + 2 < levels; ++k) {
      const double coarse = (16 * central[k + 1][i] - central[k][i]) / 15,
                   fine = (16 * central[k + 2][i] - central[k + 1][i]) / 15;
      const double rounding = std::numeric_limits<double>::epsilon() * size[i] / step[k + 2];
      const double uncertainty = std::abs(fine - coarse) + rounding;
      if (uncertainty < found[i].uncertainty) found[i] = {fine, uncertainty};
    }
    // f′(0⁺) − f′(0⁻) = bend(h) − a h − b h³ − O(h⁵): the step in the slope where there is a kink and nothing
    // elsewhere.
    double kink = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 2 < levels; ++k) {
      const double coarse = (4 * bend[k + 1][i] - bend[k][i]) / 3, fine = (4 * bend[k + 2][i] - bend[k + 1][i]) / 3;
      if (const double seen = std::abs(64 * fine - coarse) / 63; seen < kink) kink = seen;
    }
    if (std::isfinite(kink)) found[i].uncertainty += kink / 2;
  }
  return found;
}

/// Largest magnitude, or `least` where all are smaller.
inline double scale_of(std::span<const double> values, double least = 1e-300) {
  double scale = least;
  for (const double value : values)
    if (std::abs(value) > scale) scale = std::abs(value);
  return scale;
}

}  // namespace tunica::conformance
