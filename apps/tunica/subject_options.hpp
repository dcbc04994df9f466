// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "comparison/simulation.hpp"

namespace CLI {
class App;
}

namespace tunica::app {

/// Which model at which parameters: the options that `simulate` and `stability` have in common.
struct SubjectOptions {
  std::string file, model, parameters, run;
};

void add_subject_options(CLI::App& verb, SubjectOptions& options);

comparison::SimulationRequest request_of(const SubjectOptions& options);

}  // namespace tunica::app
