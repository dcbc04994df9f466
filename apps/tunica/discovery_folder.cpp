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

}  // namespace tunica::app
