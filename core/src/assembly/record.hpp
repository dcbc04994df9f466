// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "experiment/experiment.hpp"

/// Contradictions between the record of a test and the rest of its entry.
namespace tunica::assembly {

/// Compares the diameter at zero pressure with the unloaded diameter of the entry. An axially stretched tube is
/// thinner, by λz^(−1/2) if the wall keeps its volume. Any diameter between that and the unloaded one is therefore
/// plausible.
void look_at_unloaded_tube(const experiment::TestEntry& entry, const data::Dataset& dataset,
                           std::vector<data::Finding>& findings);

/// A stated noise as large as the measured values: 2 is 200 %.
void look_at_noise(const experiment::TestEntry& entry, const data::Dataset& dataset,
                   std::vector<data::Finding>& findings);

/// Column headers that name another stress or strain measure than the one they are read as.
void look_at_headers(const experiment::TestEntry& entry, std::vector<data::Finding>& findings);

/// Compares the secant stiffness of a strip or a sheet with published values of the material. The secant stiffness is
/// the largest stress over the largest stretch minus 1. A question if it lies far outside, else empty.
std::string stiffness_question(const experiment::TestEntry& entry, const data::Dataset& dataset,
                               const std::string& material);

}  // namespace tunica::assembly
