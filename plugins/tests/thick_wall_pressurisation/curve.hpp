// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "path.hpp"

namespace tunica::thick_wall {

/// The fewest rows at one axial stretch for which sampling the curve costs less than following it.
inline constexpr std::size_t fewest_on_curve = 8;

/// Where the rows at one axial stretch lie, all at once. The pressure is an explicit function of y = ln ri, which is
/// sampled from the unpressurised state `free` on. Hermite's polynomial through the samples is solved for each row.
///
/// Sets y of each row, good to 1e-6 where the pressure is smooth. False where the samples do not reach a pressure, or
/// where it may not rise between them. Then Path has to be asked. `error` grows to the largest estimate of what
/// quadrature leaves in y.
bool find_on_curve(const Equilibrium& free, std::span<const double> pressure, Sections& sections, std::span<double> y,
                   double& error);

}  // namespace tunica::thick_wall
