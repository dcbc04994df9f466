// SPDX-License-Identifier: Apache-2.0
#include "cohort/discovery_folder.hpp"

#include "execution/files.hpp"

namespace tunica::cohort {

void write_discovery(const std::filesystem::path& directory, const DiscoveryStudy& study, const Specification& cohort,
                     const SpecimenTable& table, const plugins::Catalogue& catalogue) {
  execution::write_atomically(directory / "cohort.json", cohort.text);
  execution::write_atomically(directory / "terms.csv", term_table(table, study));
  if (!study.extended.empty()) {
    execution::write_atomically(directory / "extended.json", study.extended);
    execution::write_atomically(directory / "extended_cohort.json", study.extended_cohort);
  }
  execution::write_atomically(directory / "result.json", discovery_document(cohort, study, catalogue));
}

}  // namespace tunica::cohort
