// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "experiment/experiment.hpp"

/// What the record of a test says against the rest of its entry.
namespace tunica::assembly {

/// The diameter at zero pressure against the unloaded one of the entry. A tube that is held longer is thinner, by
/// λz^(−1/2) where the wall keeps its volume, so anything between that and the unloaded diameter is right.
void look_at_unloaded_tube(const experiment::TestEntry& entry, const data::Dataset& dataset,
                           std::vector<data::Finding>& findings);

/// A stated noise as large as what was measured: 2 is 200 %.
void look_at_noise(const experiment::TestEntry& entry, const data::Dataset& dataset,
                   std::vector<data::Finding>& findings);

/// Headers of columns that speak of another stress measure, or of another strain, than they are read as.
void look_at_headers(const experiment::TestEntry& entry, std::vector<data::Finding>& findings);

/// Secant stiffness of a strip or a sheet, largest stress over largest stretch less 1, against published ones of the
/// material: a question where it lies far outside, else empty.
std::string stiffness_question(const experiment::TestEntry& entry, const data::Dataset& dataset,
                               const std::string& material);

}  // namespace tunica::assembly
