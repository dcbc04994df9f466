// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "answer.hpp"
#include "comparison/simulation_record.hpp"
#include "execution/run_directory.hpp"
#include "exit_codes.hpp"
#include "finite_range.hpp"
#include "messages.hpp"
#include "report/report.hpp"
#include "subject_options.hpp"
#include "text/aside.hpp"
#include "text/wrapping.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct SimulateOptions {
  SubjectOptions subject;
  std::string directory;
  std::vector<std::string> fields;
  double noise = 0;
  std::optional<std::uint64_t> seed;
};

int simulate(const GlobalOptions& global, const SimulateOptions& options) {
  const Session session(global);
  const auto experiment = session.read(options.subject.file, experiment::Purpose::prediction);
  auto request = request_of(options.subject);
  request.noise = options.noise;
  request.seed = options.seed.value_or(experiment.seed);
  const auto subject = comparison::subject_of(experiment, session.catalogue(), request);
  text::aside("{}\n", text::hanging("", subject.origin));
  for (const auto& warning : subject.warnings) say_wrapped_warning(warning);
  const auto simulation =
      comparison::simulate_with_fields(experiment, session.catalogue(), request, subject, options.fields);
  const auto directory = execution::RunDirectory::create(std::filesystem::path(options.directory), experiment.name);
  execution::NewResults results(directory);
  const auto files = comparison::write_simulation(directory.path(), experiment, request, subject, simulation);
  results.complete();
  for (const auto& file : files) answer("{}\n", file.string());
  answer("{}\n", report::write_report(directory.path()).string());
  return done;
}

}  // namespace

void add_simulate(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<SimulateOptions>();
  auto* verb =
      app.add_subcommand("simulate", "Predict every test and write it in the form of the data: DIR/<test>.csv");
  add_subject_options(*verb, options->subject);
  verb->add_option("--noise", options->noise, "Add relative noise: y (1 + R N(0, 1))")
      ->check(FiniteRange(0, 100))
      ->type_name("R");
  verb->add_option("--seed", options->seed, "Seed of the noise (default: that of the experiment)")
      ->check(seed_number())
      ->type_name("S");
  verb->add_option("--fields", options->fields,
                   "Also write the fields of a test, as VTK and through the wall: TEST or TEST:ROW,ROW,…")
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
