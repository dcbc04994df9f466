// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tunica/test.hpp"

namespace tunica::uniaxial {

enum class Measure { cauchy, first_piola_kirchhoff, second_piola_kirchhoff };
enum class Channel { stress, transverse_stretch, normal_stretch, volume_ratio };

/// The strip as it was bound: what both paths need. Axes: `loaded` is the material axis the strip is pulled along
/// (0 = circumferential, 1 = axial), `transverse` the other in-plane axis, 2 the normal (radial) one.
struct Strip {
  std::size_t loaded = 0, transverse = 1;
  double turn = 0;  ///< from `loaded` to the strip, in the sense of the misalignment, degrees
  Measure measure = Measure::cauchy;
  std::vector<Channel> channels;
  std::vector<double> stretch;
  std::vector<double> time;  ///< empty = equilibrium
};

/// The state of the free strip at one row, with y = ln λ2² and l = ln λ1: Cauchy stress and its derivatives along
/// the free path (total, lateral equilibrium kept).
struct RowSolution {
  double stretch, stress, y;
  double stress_by_l, y_by_l;
};

/// The channel's value, and its derivative from those of Cauchy stress and y at fixed stretch.
///   P = σ/λ1, S = σ/λ1²; λ2 = e^{y/2}; λ3 = 1/(λ1 λ2); J = 1.
double channel_value(Channel channel, Measure measure, const RowSolution& row);
double channel_derivative(Channel channel, Measure measure, const RowSolution& row, double stress_p, double y_p);
double channel_by_stretch(Channel channel, Measure measure, const RowSolution& row);

/// Room for n numbers in scratch that never shrinks.
inline std::span<double> room(std::vector<double>& values, std::size_t n) {
  if (values.size() < n) values.resize(n);
  return {values.data(), n};
}

/// "row 34 (stretch 1.87)"
std::string row_name(const Strip& strip, std::span<const double> stretch, std::size_t row);

}  // namespace tunica::uniaxial
