// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "edges.hpp"
#include "field_rows.hpp"
#include "specimen.hpp"

namespace tunica::field {

/// Smoothed measured displacements of every step, by dof. Those of the edges are of the form that edges may have: the
/// sum of `modes` that is nearest, 0 where a side is fixed. `places` are those of the points of the rows. What is
/// smooth is the difference from `reference`, by step and dof; of 0 where that is empty.
std::vector<std::vector<double>> starts(const Specimen& specimen, const FieldRows& rows,
                                        const std::vector<Place>& places, const std::vector<Mode>& modes,
                                        const std::vector<std::vector<double>>& reference);

}  // namespace tunica::field
