// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cohort/discovery_study.hpp"

namespace tunica::cohort {

/// Writes what the discovery of a cohort leaves: terms.csv, extended.json and extended_cohort.json where there are
/// terms, result.json last.
void write_discovery(const std::filesystem::path& directory, const DiscoveryStudy& study, const Specification& cohort,
                     const SpecimenTable& table, const plugins::Catalogue& catalogue);

}  // namespace tunica::cohort
