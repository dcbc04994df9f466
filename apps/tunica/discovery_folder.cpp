// SPDX-License-Identifier: Apache-2.0
#include "discovery_folder.hpp"

#include <string>

#include "discovery/output/outputs.hpp"
#include "execution/files.hpp"

namespace tunica::app {

bool write_discovery(const std::filesystem::path& directory, const discovery::Discovery& found,
                     const experiment::Experiment& experiment, const plugins::Catalogue& catalogue) {
  execution::write_atomically(directory / "input.json", experiment.input_json);
  const std::string extended = discovery::extended_experiment(found, catalogue);
  if (!extended.empty()) execution::write_atomically(directory / "extended.json", extended);
  execution::write_atomically(directory / "residuals.csv", discovery::residual_table(found));
  execution::write_atomically(directory / "result.json", discovery::result_document(found, experiment, catalogue));
  return !extended.empty();
}

void write_cohort_discovery(const std::filesystem::path& directory, const cohort::DiscoveryStudy& study,
                            const cohort::Specification& cohort, const cohort::SpecimenTable& table,
                            const plugins::Catalogue& catalogue) {
  execution::write_atomically(directory / "cohort.json", cohort.text);
  execution::write_atomically(directory / "terms.csv", cohort::term_table(table, study));
  if (!study.extended.empty()) {
    execution::write_atomically(directory / "extended.json", study.extended);
    execution::write_atomically(directory / "extended_cohort.json", study.extended_cohort);
  }
  execution::write_atomically(directory / "result.json", cohort::discovery_document(cohort, study, catalogue));
}

}  // namespace tunica::app
