// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "discovery/discovery.hpp"

namespace tunica::discovery {

/// Writes what a discovery leaves into its folder, result.json last. Whether there is an extended.json.
bool write_discovery(const std::filesystem::path& directory, const Discovery& found,
                     const experiment::Experiment& experiment, const plugins::Catalogue& catalogue);

}  // namespace tunica::discovery
