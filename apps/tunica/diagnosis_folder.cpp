// SPDX-License-Identifier: Apache-2.0
#include "diagnosis_folder.hpp"

#include <string>

#include <nlohmann/json.hpp>

#include "diagnosis/output/outputs.hpp"
#include "execution/files.hpp"

namespace tunica::app {

void write_diagnosis(const std::filesystem::path& directory, const diagnosis::Diagnosis& found,
                     const experiment::Experiment& experiment, const plugins::Catalogue& catalogue) {
  execution::write_atomically(directory / "input.json", experiment.input_json);
  if (const std::string text = diagnosis::extended_experiment(found, catalogue); !text.empty())
    execution::write_atomically(directory / "extended.json", text);
  diagnosis::write_tables(directory, found);
  execution::write_atomically(directory / "result.json", diagnosis::result_document(found, experiment, catalogue));
}

}  // namespace tunica::app
