// SPDX-License-Identifier: Apache-2.0
#include "comparison/simulation_record.hpp"

#include <nlohmann/json.hpp>

#include "execution/files.hpp"
#include "results/keys.hpp"

namespace tunica::comparison {

namespace key = results::key;

Simulation simulate_with_fields(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                                const SimulationRequest& request, const Subject& subject,
                                const std::vector<std::string>& fields) {
  Simulation simulation{simulate(experiment, catalogue, request, subject), {}};
  for (const auto& text : fields) {
    const auto asked = field_request(text);
    simulation.fields.emplace_back(asked.test, take_snapshots(experiment, subject, asked));
  }
  return simulation;
}

std::vector<std::filesystem::path> write_simulation(const std::filesystem::path& directory,
                                                    const experiment::Experiment& experiment,
                                                    const SimulationRequest& request, const Subject& subject,
                                                    const Simulation& simulation) {
  std::vector<std::filesystem::path> files;
  for (const auto& table : simulation.tables) files.push_back(write_table(directory, table));
  for (const auto& [test, snapshots] : simulation.fields)
    for (const auto& path : write_snapshots(directory, test, snapshots)) files.push_back(path);
  files.push_back(write_record(directory, experiment, request, subject, simulation));
  return files;
}

std::filesystem::path write_record(const std::filesystem::path& directory, const experiment::Experiment& experiment,
                                   const SimulationRequest& request, const Subject& subject,
                                   const Simulation& simulation) {
  nlohmann::ordered_json record{
      {key::name, experiment.name}, {key::model, subject.model}, {key::tests, nlohmann::ordered_json::array()}};
  for (const auto& test : experiment.tests) record[key::tests].push_back(test.name);
  auto& parameters = record[key::parameters] = nlohmann::ordered_json::object();
  const auto& free = subject.assembly->layout().parameters;
  for (std::size_t j = 0; j < free.size(); ++j)
    parameters[free[j].name] = {{key::value, subject.free[j]}, {key::unit, free[j].unit}};
  for (const auto& parameter : subject.assembly->layout().fixed_parameters)
    parameters[parameter.name] = {{key::value, parameter.value}, {key::unit, parameter.unit}};
  record[key::source] = subject.source;
  record[key::origin] = subject.origin;
  record[key::noise] = request.noise;
  record[key::seed] = request.seed;
  record[key::warnings] = subject.warnings;
  auto& curves = record[key::curves] = nlohmann::ordered_json::array();
  for (const SimulatedTable& table : simulation.tables)
    for (const SimulatedTable::Curve& curve : table.curves)
      curves.push_back({{key::test, table.test},
                        {key::column, curve.column},
                        {key::over, curve.over},
                        {key::prescribed, table.prescribed}});
  auto file = directory / "simulation.json";
  execution::write_atomically(file, record.dump(2, ' ', false, decltype(record)::error_handler_t::replace) + '\n');
  return file;
}

}  // namespace tunica::comparison
