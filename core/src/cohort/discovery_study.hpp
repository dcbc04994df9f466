// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "cohort/fitting.hpp"
#include "discovery/common/common_discovery.hpp"
#include "text/styled.hpp"

namespace tunica::cohort {

/// The terms that the energy of all specimens lacks: docs/discovery.md.
struct DiscoveryStudy {
  discovery::CommonDiscovery found;
  experiment::Experiment first;             ///< of the first specimen that can be read
  std::vector<std::size_t> positions = {};  ///< in the table, of the specimens that take part
  std::string extended = {},
              extended_cohort = {};  ///< texts of extended.json and extended_cohort.json; empty = no terms
  std::string not_extended = {};     ///< why there is no extended.json although there are terms
};

/// What is asked, of the experiment of a specimen.
using DiscoveryRequestOf = std::function<discovery::Request(const experiment::Experiment&)>;

/// Searches all specimens at once; one that cannot be read is left out with its reason. Throws InputError where none
/// can be read, and as discover_together() does.
DiscoveryStudy study_discovery(const Specification& cohort, const SpecimenTable& table, const Template& pattern,
                               const plugins::Catalogue& catalogue, const DiscoveryRequestOf& request_of,
                               const diagnosis::Progress& progress);

/// The whole of result.json, as schemas/tunica-result.schema.json says.
std::string discovery_document(const Specification& cohort, const DiscoveryStudy& study,
                               const plugins::Catalogue& catalogue);

/// terms.csv in long form: specimen, <column of the table> …, gain, term, parameter, unit, value, low, high. The gain
/// is in natural logarithms of the evidence; the rest is empty for a term that does not show in the specimen.
std::string term_table(const SpecimenTable& table, const DiscoveryStudy& study);

/// What the program prints of it.
text::StyledText discovery_words(const DiscoveryStudy& study);

}  // namespace tunica::cohort
