// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "elastic.hpp"

namespace tunica::thick_wall {

/// Tables through the wall at the given rows, from inside, for a material without history; no mesh. Stretches are those
/// from the stress-free state. The radial stress is what the wall further out holds,
///
///   σr(r) = −p_o − ∫_r^{ro} (σt − σr)/r dr,   p_o the pressure of the support,
///
/// a Gauss point counting half for itself: good to about 1e-3 of the pressure, for pictures.
Status through_wall(const Tube& tube, const TestInput& input, std::span<const std::size_t> rows,
                    std::vector<Snapshot>& found);

}  // namespace tunica::thick_wall
