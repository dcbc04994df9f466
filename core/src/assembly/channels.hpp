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

/// Which of the rows of a test are fitted: those that are not held out. The file's rows are meant, wherever they stand.
std::vector<bool> fitted_rows(const experiment::TestEntry& entry, const data::Dataset& dataset);

/// What one test measured, channel by channel; its first row lies at `offset` of the predictions. Throws InputError
/// where weights or held-out rows do not fit the data.
std::vector<MeasuredChannel> measured_channels(const experiment::TestEntry& entry, const data::Dataset& dataset,
                                               const std::vector<Observable>& observables, std::size_t offset);

}  // namespace tunica::assembly
