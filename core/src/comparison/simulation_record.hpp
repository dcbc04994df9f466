// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "comparison/simulation.hpp"

namespace tunica::comparison {

/// Writes directory/simulation.json, what the tables beside it were made with: the names of experiment and model, the
/// tests, the parameters {name: {value, unit}}, fixed ones included, where they came from, noise, seed and warnings.
/// Returns its path.
std::filesystem::path write_record(const std::filesystem::path& directory, const experiment::Experiment& experiment,
                                   const SimulationRequest& request, const Subject& subject);

}  // namespace tunica::comparison
