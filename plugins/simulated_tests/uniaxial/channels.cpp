// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "uniaxial.hpp"

namespace tunica::uniaxial {
namespace {

/// Cauchy stress to the data's measure: division by λ1 to this power.
int power(Measure measure) {
  return measure == Measure::cauchy ? 0 : measure == Measure::first_piola_kirchhoff ? 1 : 2;
}
double measure_factor(Measure measure, double stretch) {
  return power(measure) == 0 ? 1 : power(measure) == 1 ? 1 / stretch : 1 / (stretch * stretch);
}

}  // namespace

double channel_value(Channel channel, Measure measure, const RowSolution& row) {
  if (channel == Channel::stress) return row.stress * measure_factor(measure, row.stretch);
  if (channel == Channel::volume_ratio) return 1;
  const double transverse = std::exp(row.y / 2);
  return channel == Channel::transverse_stretch ? transverse : 1 / (row.stretch * transverse);
}

double channel_derivative(Channel channel, Measure measure, const RowSolution& row, double stress_p, double y_p) {
  if (channel == Channel::stress) return stress_p * measure_factor(measure, row.stretch);
  if (channel == Channel::volume_ratio) return 0;
  const double transverse = std::exp(row.y / 2);
  return channel == Channel::transverse_stretch ? transverse * y_p / 2 : -y_p / (2 * row.stretch * transverse);
}

double channel_by_stretch(Channel channel, Measure measure, const RowSolution& row) {
  if (channel == Channel::stress)
    return (row.stress_by_l - power(measure) * row.stress) * measure_factor(measure, row.stretch) / row.stretch;
  if (channel == Channel::volume_ratio) return 0;
  const double transverse = std::exp(row.y / 2);
  if (channel == Channel::transverse_stretch) return transverse * row.y_by_l / (2 * row.stretch);
  return -(1 + row.y_by_l / 2) / (row.stretch * row.stretch * transverse);
}

std::string row_name(const Strip&, std::span<const double> stretch, std::size_t row) {
  std::string number = std::to_string(stretch[row]);
  return "row " + std::to_string(row + 1) + " (stretch " + number + ")";
}

}  // namespace tunica::uniaxial
