// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulation.hpp"
#include "tunica/test.hpp"

namespace tunica::fe {

/// The same elements where the solution is known otherwise:
///   - the tube with sliding ends, which is a long one: pressure and force are integrals over the wall
///     (docs/theory.md), here by Simpson's rule;
///   - for each layer, one element of a ring far from the axis, stretched without pressure: a strip with free lateral
///   faces.
/// Loads: no pressure, the largest of `loads` and half of it, at the axial stretch of the largest.
/// The support from outside is left out.
Status check_agreement(const Tube& tube, const thick_wall::Wall& wall, const Material& material, const TestInput& input,
                       std::span<const Load> loads, std::vector<Agreement>& found);

}  // namespace tunica::fe
