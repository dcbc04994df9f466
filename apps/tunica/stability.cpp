// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "answer.hpp"
#include "comparison/stability_answer.hpp"
#include "exit_codes.hpp"
#include "finite_range.hpp"
#include "messages.hpp"
#include "plugins/description.hpp"
#include "subject_options.hpp"
#include "text/wrapping.hpp"
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

int stability(const GlobalOptions& global, const StabilityOptions& options) {
  const Session session(global);
  const auto experiment = session.read(options.subject.file, experiment::Purpose::prediction);
  const auto subject = comparison::subject_of(experiment, session.catalogue(), request_of(options.subject));
  comparison::StabilityRequest request;
  if (options.to > 1) request.to = options.to;
  if (!options.map.empty()) request.map = {options.map[0], options.map[1]};
  request.points = options.points;
  if (!options.directory.empty()) request.directory = options.directory;
  const auto judged = comparison::judge_stability(experiment.name, subject, request);
  for (const auto& warning : subject.warnings) say_wrapped_warning(warning);
  if (options.as_json)
    print_json(comparison::stability_answer_json(subject, judged));
  else
    print(subject, judged.found, judged.files);
  return judged.any_assessed() ? done : not_converged;
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
