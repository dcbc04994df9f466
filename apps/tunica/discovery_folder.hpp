// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cohort/discovery_study.hpp"
#include "discovery/discovery.hpp"

namespace tunica::app {

/// Writes what a discovery leaves into its folder, result.json last. Whether there is an extended.json.
bool write_discovery(const std::filesystem::path& directory, const discovery::Discovery& found,
                     const experiment::Experiment& experiment, const plugins::Catalogue& catalogue);

/// The same of a cohort: terms.csv, extended.json and extended_cohort.json where there are terms, result.json last.
void write_cohort_discovery(const std::filesystem::path& directory, const cohort::DiscoveryStudy& study,
                            const cohort::Specification& cohort, const cohort::SpecimenTable& table,
                            const plugins::Catalogue& catalogue);

}  // namespace tunica::app
