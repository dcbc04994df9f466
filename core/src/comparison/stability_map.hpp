// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>

#include "assembly/assembly.hpp"

namespace tunica::comparison {

/// Where in the plane of two free parameters, between their bounds (logarithmically where they are searched so), the
/// others held at `free`, a strip is transversely stable from rest to `limit` along either axis (of several models: of
/// each). CSV text, one row a point:
///
///   <x> [unit], <y> [unit], stable (1 or 0), first_unstable_circumferential, first_unstable_axial, worst_slope
///
/// worst_slope is the largest d ln λ3/d ln λ1; its zero is the border. Throws InputError where a name is not free.
std::string stability_map(const assembly::Assembly& assembly, std::span<const double> free,
                          const std::array<std::string, 2>& names, std::size_t points, double limit);

}  // namespace tunica::comparison
