// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "assembly/layout.hpp"
#include "data/dataset.hpp"
#include "experiment/experiment.hpp"
#include "tunica/test.hpp"

namespace tunica::assembly {

/// The rows of a test that are fitted: those that are not held out. Held-out rows are numbered as in the file, whatever
/// their order here.
std::vector<bool> fitted_rows(const experiment::TestEntry& entry, const data::Dataset& dataset);

/// The measured channels of one test; its first row is at `offset` in the predictions. Throws InputError if weights or
/// held-out rows do not match the data.
std::vector<MeasuredChannel> measured_channels(const experiment::TestEntry& entry, const data::Dataset& dataset,
                                               const std::vector<Observable>& observables, std::size_t offset);

}  // namespace tunica::assembly
