// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulation.hpp"
#include "tunica/test.hpp"

namespace tunica::fe {

/// The loaded half of the tube's section at the given rows of `loads`, r as x and z as y: displacement of the nodes;
/// stretches, Cauchy stresses, pressure and fibre stretch in the mean of every element; and the same at the Gauss
/// points through the wall next to mid-length. Fibre families are those of the model's parts.
Status snapshots_of(const Tube& tube, const TestInput& input, const Material& material, std::span<const Load> loads,
                    std::span<const std::size_t> rows, std::vector<Snapshot>& found);

}  // namespace tunica::fe
