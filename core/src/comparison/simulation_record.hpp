// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "comparison/simulation.hpp"
#include "comparison/snapshots.hpp"

namespace tunica::comparison {

/// All tests of a subject, and the fields of some.
struct Simulation {
  std::vector<SimulatedTable> tables;
  std::vector<std::pair<std::string, std::vector<Snapshot>>> fields;  ///< by test
};

/// `fields`: "TEST" or "TEST:ROW,ROW,…", see field_request(). Throws InputError.
Simulation simulate_with_fields(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                                const SimulationRequest& request, const Subject& subject,
                                const std::vector<std::string>& fields);

/// Writes the tables, the fields and simulation.json; returns all their paths in that order.
std::vector<std::filesystem::path> write_simulation(const std::filesystem::path& directory,
                                                    const experiment::Experiment& experiment,
                                                    const SimulationRequest& request, const Subject& subject,
                                                    const Simulation& simulation);

/// Writes directory/simulation.json, what the tables beside it were made with: the names of experiment and model, the
/// tests, the parameters {name: {value, unit}}, fixed ones included, where they came from, noise, seed and warnings,
/// and what each predicted column is drawn over. Returns its path.
std::filesystem::path write_record(const std::filesystem::path& directory, const experiment::Experiment& experiment,
                                   const SimulationRequest& request, const Subject& subject,
                                   const Simulation& simulation);

}  // namespace tunica::comparison
