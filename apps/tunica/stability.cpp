// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "answer.hpp"
#include "comparison/stability_map.hpp"
#include "comparison/stability_report.hpp"
#include "comparison/summary.hpp"
#include "describe.hpp"
#include "execution/run_directory.hpp"
#include "exit_codes.hpp"
#include "finite_range.hpp"
#include "messages.hpp"
#include "subject_options.hpp"
#include "text/wrapping.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct StabilityOptions {
  SubjectOptions subject;
  std::string directory;
  std::vector<std::string> map;
  std::size_t points = 41;
  double to = 0;
  bool as_json = false;
};

void print(const comparison::Subject& subject, const comparison::StabilitySummary& found,
           const std::vector<std::string>& files) {
  answer("{}\n{}\n", subject.model, text::hanging("  ", subject.origin));
  for (const auto& [name, verdict, inadmissible] : found.models) {
    if (found.models.size() > 1) answer("  model '{}'\n", name);
    const char* const margin = found.models.size() > 1 ? "    " : "  ";
    for (const auto& sentence : verdict.sentences()) answer("{}\n", text::hanging(margin, sentence));
  }
  for (const auto& file : files) answer("{}\n", file);
}

/// Whether the response could be followed anywhere: without, nothing was judged.
bool any_assessed(const comparison::StabilitySummary& found) {
  const auto reached = [](const auto& followed) {
    return std::any_of(followed.begin(), followed.end(), [](const auto& path) { return path.to != 1; });
  };
  return std::any_of(found.models.begin(), found.models.end(), [&](const auto& model) {
    const auto& strips = model.verdict.transverse;
    const bool pulled = std::any_of(strips.begin(), strips.end(),
                                    [](const auto& strip) { return strip.checked_from < 1 || strip.checked_to > 1; });
    return pulled || reached(model.verdict.ellipticity.followed);
  });
}

/// As `best.stability` of result.json, with the parameters that were judged.
nlohmann::ordered_json json_of(const comparison::Subject& subject, const comparison::StabilitySummary& found,
                               const std::vector<std::string>& files) {
  nlohmann::ordered_json document = {{"model", subject.model}, {"origin", subject.origin}};
  auto& parameters = document["parameters"] = nlohmann::ordered_json::object();
  const auto& free = subject.assembly->layout().parameters;
  for (std::size_t i = 0; i < free.size(); ++i)
    parameters[free[i].name] = {{"value", subject.free[i]}, {"unit", free[i].unit}};
  for (const auto& fixed : subject.assembly->layout().fixed_parameters)
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
  const auto experiment = session.read(options.subject.file, experiment::Purpose::prediction);
  const auto subject = comparison::subject_of(experiment, session.catalogue(), request_of(options.subject));
  const std::optional<double> to = options.to > 1 ? std::optional(options.to) : std::nullopt;
  // A map that cannot be drawn, or a folder that is there already, is said before anything else.
  std::string map;
  if (!options.map.empty())
    map = comparison::stability_map(*subject.assembly, subject.free, {options.map[0], options.map[1]}, options.points,
                                    comparison::domain_of(*subject.assembly, 0, to).largest);
  std::optional<execution::RunDirectory> directory;
  if (!options.directory.empty())
    directory.emplace(execution::RunDirectory::create(std::filesystem::path(options.directory), experiment.name));
  for (const auto& warning : subject.warnings) say_wrapped_warning(warning);
  const auto found = comparison::stability_of(*subject.assembly, subject.free, to);
  std::vector<std::string> files;
  if (directory) {
    execution::NewResults results(*directory);
    for (const auto& file : comparison::write_stability(directory->path(), subject, to, map))
      files.push_back(file.string());
    results.complete();
  }
  if (options.as_json)
    print_json(json_of(subject, found, files));
  else
    print(subject, found, files);
  return any_assessed(found) ? done : not_converged;
}

}  // namespace

void add_stability(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<StabilityOptions>();
  auto* verb =
      app.add_subcommand("stability", "Judge whether a parameter set is a stable material, and over which stretches");
  add_subject_options(*verb, options->subject);
  verb->add_option("--to", options->to, "Judge up to this stretch (default: the largest measured one)")
      ->check(FiniteRange(1, 100))
      ->type_name("STRETCH");
  verb->add_option("--map", options->map, "Map where the material is stable between the bounds of two free parameters")
      ->expected(2)
      ->type_name("X Y");
  verb->add_option("--points", options->points, "Points of the map along each parameter")
      ->check(CLI::Range(2, 1001))
      ->capture_default_str()
      ->type_name("N");
  verb->add_option("-o,--output", options->directory,
                   "New folder: stability.csv (strips), energy.csv (isocontours), stability_map.csv")
      ->type_name("DIR");
  verb->add_flag("--json", options->as_json, "Print one JSON object, in the form of `best.stability` of result.json");
  verb->footer(
      "Examples:\n"
      "  tunica stability experiment.json --model gho --parameters a/result.json\n"
      "  tunica stability experiment.json --model gho --to 2 --map kappa k2 -o map");
  verb->callback([&global, &action, options] { action = [&global, options] { return stability(global, *options); }; });
}

}  // namespace tunica::app
