// SPDX-License-Identifier: Apache-2.0
#include "comparison/simulation_record.hpp"

#include <nlohmann/json.hpp>

#include "execution/files.hpp"

namespace tunica::comparison {

std::filesystem::path write_record(const std::filesystem::path& directory, const experiment::Experiment& experiment,
                                   const SimulationRequest& request, const Subject& subject) {
  nlohmann::ordered_json record{
      {"name", experiment.name}, {"model", subject.model}, {"tests", nlohmann::ordered_json::array()}};
  for (const auto& test : experiment.tests) record["tests"].push_back(test.name);
  auto& parameters = record["parameters"] = nlohmann::ordered_json::object();
  const auto& free = subject.assembly->layout().parameters;
  for (std::size_t j = 0; j < free.size(); ++j)
    parameters[free[j].name] = {{"value", subject.free[j]}, {"unit", free[j].unit}};
  for (const auto& parameter : subject.assembly->layout().fixed_parameters)
    parameters[parameter.name] = {{"value", parameter.value}, {"unit", parameter.unit}};
  record["source"] = subject.source;
  record["origin"] = subject.origin;
  record["noise"] = request.noise;
  record["seed"] = request.seed;
  record["warnings"] = subject.warnings;
  auto file = directory / "simulation.json";
  execution::write_atomically(file, record.dump(2) + '\n');
  return file;
}

}  // namespace tunica::comparison
