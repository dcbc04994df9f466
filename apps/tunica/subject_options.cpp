// SPDX-License-Identifier: Apache-2.0
#include "subject_options.hpp"

#include <CLI/CLI.hpp>

namespace tunica::app {

void add_subject_options(CLI::App& verb, SubjectOptions& options) {
  verb.add_option("experiment", options.file, "Experiment file (JSON)")->required()->type_name("EXP");
  verb.add_option("--model", options.model,
                  "Name of a model in the experiment; leave it out where all tests name theirs in layers")
      ->type_name("M");
  verb.add_option("--parameters", options.parameters,
                  "A result.json, or a JSON object {name: value} (default: the fixed and initial values)")
      ->type_name("FILE");
  verb.add_option("--run", options.run, "A run of that result.json (default: the best-ranked one of the model)")
      ->type_name("RUN");
}

comparison::SimulationRequest request_of(const SubjectOptions& options) {
  comparison::SimulationRequest request;
  request.model = options.model;
  if (!options.parameters.empty()) request.parameters = options.parameters;
  request.run = options.run;
  return request;
}

}  // namespace tunica::app
