// SPDX-License-Identifier: Apache-2.0
#include "discovery/output/folder.hpp"

#include <string>

#include "discovery/output/outputs.hpp"
#include "execution/files.hpp"

namespace tunica::discovery {

bool write_discovery(const std::filesystem::path& directory, const Discovery& found,
                     const experiment::Experiment& experiment, const plugins::Catalogue& catalogue) {
  execution::write_atomically(directory / "input.json", experiment.input_json);
  const std::string extended = extended_experiment(found, catalogue);
  if (!extended.empty()) execution::write_atomically(directory / "extended.json", extended);
  execution::write_atomically(directory / "residuals.csv", residual_table(found));
  execution::write_atomically(directory / "result.json", result_document(found, experiment, catalogue));
  return !extended.empty();
}

}  // namespace tunica::discovery
