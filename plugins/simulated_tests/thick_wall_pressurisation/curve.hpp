// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "path.hpp"

namespace tunica::thick_wall {

/// The fewest rows at one axial stretch for which sampling the curve costs less than following it.
inline constexpr std::size_t fewest_on_curve = 8;

/// The rows that the samples of a curve do not settle.
struct CurveError {
  double quadrature = 0;     ///< the largest estimate of what quadrature leaves in y
  double interpolation = 0;  ///< the largest estimate of what is left in y between the samples
  double force = 0;          ///< and in the axial force, of its largest value
};

/// Where the rows at one axial stretch lie, all at once. The pressure is an explicit function of y = ln ri, which is
/// sampled from the unpressurised state on. Hermite's polynomial through the samples is solved for each row.
///
/// Sets y of each row, and the axial force of each where `force` is not empty. False where the samples do not reach a
/// pressure, where it may not rise between them, or where the way to the axial stretch is not plain. Then Path has to
/// be asked.
bool find_on_curve(double axial_stretch, std::span<const double> pressure, const Wall& wall, Sections& sections,
                   std::span<double> y, std::span<double> force, CurveError& error);

}  // namespace tunica::thick_wall
