// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "experiment/experiment.hpp"

namespace tunica::experiment {

/// read_experiment() of a text that need not stand in a file. `file` is what messages call it; the data files are
/// relative to its folder. Throws InputError.
Experiment parse_experiment(std::string text, const std::filesystem::path& file, const plugins::Catalogue& catalogue,
                            Purpose purpose = Purpose::search);

}  // namespace tunica::experiment
