// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "comparison/simulation.hpp"
#include "comparison/stability_map.hpp"
#include "comparison/stability_report.hpp"
#include "comparison/summary.hpp"
#include "comparison/text.hpp"
#include "describe.hpp"
#include "execution/files.hpp"
#include "execution/run_directory.hpp"
#include "exit_codes.hpp"
#include "messages.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct StabilityOptions {
  std::string file, model, parameters, run, directory;
  std::vector<std::string> map;
  std::size_t points = 41;
  double to = 0;
  bool as_json = false;
};

/// The stretches to judge a model over: those of its strips, or up to the one that was asked for.
tunica::stability::Domain domain_of(const calibration::Assembly& assembly, std::size_t model,
                                    const StabilityOptions& options) {
  auto domain = comparison::domain_of(assembly, model);
  if (options.to > 1) {
    domain.largest = options.to;
    domain.strips = {};
    for (auto& stretches : domain.asked)
      for (int k = 1; k <= 100; ++k) stretches.push_back(1 + (options.to - 1) * k / 100);
  }
  return domain;
}

void print(const comparison::Subject& subject, const comparison::StabilitySummary& found,
           const std::vector<std::string>& files) {
  fmt::print("{}\n{}\n", subject.model, comparison::hanging("  ", subject.origin));
  for (const auto& [name, verdict, inadmissible] : found.models) {
    if (found.models.size() > 1) fmt::print("  model '{}'\n", name);
    const char* const margin = found.models.size() > 1 ? "    " : "  ";
    for (const auto& sentence : verdict.sentences()) fmt::print("{}\n", comparison::hanging(margin, sentence));
  }
  for (const auto& file : files) fmt::print("{}\n", file);
}

/// As `best.stability` of result.json, with the parameters that were judged.
nlohmann::ordered_json json_of(const comparison::Subject& subject, const comparison::StabilitySummary& found,
                               const std::vector<std::string>& files) {
  nlohmann::ordered_json document = {{"model", subject.model}, {"origin", subject.origin}};
  auto& parameters = document["parameters"] = nlohmann::ordered_json::object();
  const auto& free = subject.assembly->parameters();
  for (std::size_t i = 0; i < free.size(); ++i)
    parameters[free[i].name] = {{"value", subject.free[i]}, {"unit", free[i].unit}};
  for (const auto& fixed : subject.assembly->fixed_parameters())
    parameters[fixed.name] = {{"value", fixed.value}, {"unit", fixed.unit}};
  document["warnings"] = subject.warnings;
  const auto stable = found.transversely_stable();
  document["stable"] = stable ? nlohmann::ordered_json(*stable) : nullptr;
  comparison::RunSummary run;
  run.stability = found;
  document["stability"] = comparison::stability_json(run);
  for (const char* of_runs : {"imposed", "ratio_to_free"}) document["stability"].erase(of_runs);
  document["files"] = files;
  return document;
}

int stability(const GlobalOptions& global, const StabilityOptions& options) {
  if (!options.map.empty() && options.directory.empty())
    throw InputError("--map writes a file: name a new folder for it with -o DIR");
  const Session session(global);
  const auto experiment = session.read(options.file);
  comparison::SimulationRequest request;
  request.model = options.model;
  if (!options.parameters.empty()) request.parameters = options.parameters;
  request.run = options.run;
  const auto subject = comparison::subject_of(experiment, session.catalogue(), request);
  const auto& assembly = *subject.assembly;
  const double limit = domain_of(assembly, 0, options).largest;
  // A map that cannot be drawn, or a folder that is there already, is said before anything else.
  std::string map;
  if (!options.map.empty())
    map = comparison::stability_map(assembly, subject.free, {options.map[0], options.map[1]}, options.points, limit);
  std::optional<execution::RunDirectory> directory;
  if (!options.directory.empty())
    directory.emplace(execution::RunDirectory::create(std::filesystem::path(options.directory), experiment.name));
  for (const auto& warning : subject.warnings) say_wrapped_warning(warning);
  comparison::StabilitySummary found;
  for (std::size_t m = 0; m < assembly.model_count(); ++m)
    found.models.push_back(
        {assembly.model_name(m),
         tunica::stability::judge_admissibility(assembly.model(m), assembly.model_parameters(m, subject.free),
                                                domain_of(assembly, m, options)),
         {}});
  std::vector<std::string> files;
  if (directory) {
    comparison::write_stability_tables(directory->path(), {{subject.model, &assembly, subject.free, limit}});
    for (const char* name : {"stability.csv", "energy.csv"}) files.push_back((directory->path() / name).string());
    if (!options.map.empty()) {
      files.push_back((directory->path() / "stability_map.csv").string());
      execution::write_atomically(files.back(), map);
    }
  }
  if (options.as_json)
    print_json(json_of(subject, found, files));
  else
    print(subject, found, files);
  return done;
}

}  // namespace

void add_stability(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<StabilityOptions>();
  auto* verb = app.add_subcommand("stability", "Is a parameter set a stable material? Over which stretches?");
  verb->add_option("experiment", options->file, "Experiment file (JSON)")->required()->type_name("EXP");
  verb->add_option("--model", options->model, "Name of a model in the experiment; not where tests name all in layers")
      ->type_name("M");
  verb->add_option("--parameters", options->parameters,
                   "A result.json, or a JSON object {name: value}; without it the fixed and initial values")
      ->type_name("FILE");
  verb->add_option("--run", options->run, "A run of that result.json instead of the best-ranked one of the model")
      ->type_name("RUN");
  verb->add_option("--to", options->to, "Judge up to this stretch instead of the largest measured one")
      ->check(CLI::Range(1.0, 100.0))
      ->type_name("STRETCH");
  verb->add_option("--map", options->map, "Two free parameters: where between their bounds is it stable?")
      ->expected(2)
      ->type_name("X Y");
  verb->add_option("--points", options->points, "Points of the map along each parameter")
      ->check(CLI::Range(2, 1001))
      ->capture_default_str()
      ->type_name("N");
  verb->add_option("-o,--output", options->directory,
                   "New folder: stability.csv (strips), energy.csv (isocontours), stability_map.csv")
      ->type_name("DIR");
  verb->add_flag("--json", options->as_json, "One JSON object, in the form of `best.stability` of result.json");
  verb->footer(
      "Examples:\n"
      "  tunica stability experiment.json --model gho --parameters a/result.json\n"
      "  tunica stability experiment.json --model gho --to 2 --map kappa k2 -o map");
  verb->callback([&global, &action, options] { action = [&global, options] { return stability(global, *options); }; });
}

}  // namespace tunica::app
