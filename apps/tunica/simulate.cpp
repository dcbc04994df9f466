// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "comparison/simulation.hpp"
#include "comparison/simulation_record.hpp"
#include "comparison/snapshots.hpp"
#include "execution/run_directory.hpp"
#include "exit_codes.hpp"
#include "messages.hpp"
#include "report/report.hpp"
#include "verbs.hpp"
#include "text/wrapping.hpp"

namespace tunica::app {

namespace {

struct SimulateOptions {
  std::string file, model, parameters, run, directory;
  std::vector<std::string> fields;
  double noise = 0;
  std::optional<std::uint64_t> seed;
};

int simulate(const GlobalOptions& global, const SimulateOptions& options) {
  const Session session(global);
  const auto experiment = session.read(options.file);
  comparison::SimulationRequest request;
  request.model = options.model;
  if (!options.parameters.empty()) request.parameters = options.parameters;
  request.noise = options.noise;
  request.seed = options.seed.value_or(experiment.seed);
  request.run = options.run;
  const auto subject = comparison::subject_of(experiment, session.catalogue(), request);
  fmt::print(stderr, "{}\n", text::hanging("", subject.origin));
  for (const auto& warning : subject.warnings) say_wrapped_warning(warning);
  const auto tables = comparison::simulate(experiment, session.catalogue(), request, subject);
  std::vector<std::pair<std::string, std::vector<Snapshot>>> fields;
  for (const auto& text : options.fields) {
    const auto asked = comparison::field_request(text);
    fields.emplace_back(asked.test, comparison::take_snapshots(experiment, subject, asked));
  }
  const auto directory = execution::RunDirectory::create(std::filesystem::path(options.directory), experiment.name);
  for (const auto& table : tables) fmt::print("{}\n", comparison::write_table(directory.path(), table).string());
  for (const auto& [test, snapshots] : fields)
    for (const auto& path : comparison::write_snapshots(directory.path(), test, snapshots))
      fmt::print("{}\n", path.string());
  fmt::print("{}\n", comparison::write_record(directory.path(), experiment, request, subject).string());
  fmt::print("{}\n", report::write_report(directory.path()).string());
  return done;
}

}  // namespace

void add_simulate(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<SimulateOptions>();
  auto* verb = app.add_subcommand("simulate", "Predict every test and write it like the data: DIR/<test>.csv");
  verb->add_option("experiment", options->file, "Experiment file (JSON)")->required()->type_name("EXP");
  verb->add_option("--model", options->model, "Name of a model in the experiment; not where tests name all in layers")
      ->type_name("M");
  verb->add_option("--parameters", options->parameters,
                   "A result.json, or a JSON object {name: value}; without it the fixed and initial values")
      ->type_name("FILE");
  verb->add_option("--run", options->run, "A run of that result.json instead of the best-ranked one of the model")
      ->type_name("RUN");
  verb->add_option("--noise", options->noise, "Relative noise: y (1 + R N(0, 1))")
      ->check(CLI::NonNegativeNumber)
      ->type_name("R");
  verb->add_option("--seed", options->seed, "Seed of the noise instead of the experiment's")
      ->check(seed_number())
      ->type_name("S");
  verb->add_option("--fields", options->fields,
                   "Also write the fields of a simulated test, as VTK and through the wall: TEST or TEST:ROW,ROW,…")
      ->type_name("TEST");
  verb->add_option("-o,--output", options->directory, "New folder")->required()->type_name("DIR");
  verb->footer(
      "Examples:\n"
      "  tunica simulate experiment.json --model gho -o predicted\n"
      "  tunica simulate experiment.json --parameters a/result.json --model gho -o sim\n"
      "  tunica simulate experiment.json --model gho --fields tube:1,35 -o fields\n"
      "  tunica simulate experiment.json --model gho --noise 0.02 --seed 3 -o synthetic");
  verb->callback([&global, &action, options] { action = [&global, options] { return simulate(global, *options); }; });
}

}  // namespace tunica::app
