// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <unistd.h>

#include "batch.hpp"
#include "data/nearest.hpp"
#include "diagnosis/evidence/base_fit.hpp"
#include "discovery/output/outputs.hpp"
#include "discovery_folder.hpp"
#include "execution/interrupt.hpp"
#include "execution/run_directory.hpp"
#include "exit_codes.hpp"
#include "messages.hpp"
#include "report/report.hpp"
#include "stages.hpp"
#include "text/terminal.hpp"
#include "text/wrapping.hpp"
#include "tunica/error.hpp"
#include "unfinished_folder.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct DiscoverOptions {
  std::string file, directory, share;
  unsigned threads = static_cast<unsigned>(tbb::info::default_concurrency());
  std::optional<std::uint64_t> seed;
  std::optional<double> alpha;
  std::optional<std::size_t> most_terms, most_parameters;
  std::vector<std::string> invariants, laws;
  std::string model;
  bool from_nothing = false, quick = false, batch = false;
};

/// Refuses words that are not among the known ones.
void check_words(const char* option, const std::vector<std::string>& words, const std::vector<std::string>& known) {
  for (const std::string& word : words)
    if (std::find(known.begin(), known.end(), word) == known.end())
      throw InputError(fmt::format("{}: '{}' is not known. {}", option, word, data::suggestion(word, known)));
}

/// The file's request, with what the command line says instead.
discovery::Request request_of(const experiment::Experiment& experiment, const DiscoverOptions& options) {
  discovery::Request request = discovery::request_of(experiment);
  check_words("--invariants", options.invariants, experiment::discovery_invariants);
  check_words("--laws", options.laws, experiment::discovery_laws);
  std::vector<std::string> models;
  for (const auto& model : experiment.models) models.push_back(model.name);
  if (!options.model.empty()) {
    check_words("--model", {options.model}, models);
    request.model = options.model;
  }
  if (options.seed) request.seed = *options.seed;
  if (options.alpha) request.alpha = *options.alpha;
  if (options.most_terms) request.most_terms = *options.most_terms;
  if (options.most_parameters) request.most_parameters = *options.most_parameters;
  if (!options.invariants.empty()) request.invariants = options.invariants;
  if (!options.laws.empty()) request.laws = options.laws;
  request.from_nothing = request.from_nothing || options.from_nothing;
  request.quick = options.quick;
  return request;
}

std::string discovery_interrupted() {
  return fmt::format(
      "{}interrupted; an unfinished discovery leaves nothing behind. Start it again with the same "
      "command\n",
      text::Terminal::of(STDERR_FILENO).redraws ? "\r\033[K" : "");
}

int discover(const GlobalOptions& global, const DiscoverOptions& options) {
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
  const Session session(global);
  const auto experiment = session.read(options.file);
  const auto request = request_of(experiment, options);
  const std::filesystem::path requested = options.directory;
  const bool was_there = !requested.empty() && std::filesystem::exists(requested);
  const bool results_were_there = std::filesystem::exists("results");
  auto directory =
      execution::RunDirectory::create(requested.empty() ? std::nullopt : std::optional(requested), experiment.name);
  std::vector<std::filesystem::path> made;
  if (!was_there) made.push_back(directory.path());
  if (requested.empty() && !results_were_there) made.push_back(directory.path().parent_path());
  discovery::Discovery found;
  try {
    UnfinishedFolder folder(made, discovery_interrupted());
    Stages stages(global.quiet);
    found = discovery::discover(experiment, request, session.catalogue(),
                                [&stages](const std::string& what, double share) { stages.tell(what, share); });
    folder.keep();
  } catch (const diagnosis::BaseFitFailure& problem) {
    say_error(fmt::format("{}. Run `tunica check {}`, which evaluates the initial point and shows what fails",
                          problem.what(), options.file));
    return not_converged;
  }
  const execution::InterruptWatch watch;  // writing takes a moment, and is not left half done
  const bool extended = write_discovery(directory.path(), found, experiment, session.catalogue());
  for (const diagnosis::Warning& warning : found.warnings) fmt::print("{}\n", text::hanging("warning: ", warning.text));
  if (!found.warnings.empty()) fmt::print("\n");
  const auto page = report::write_report(directory.path());
  fmt::print("{}\nReport:   {}\nResults:  {}\n", discovery::summary(found).shown_on(STDOUT_FILENO), page.string(),
             (directory.path() / "result.json").string());
  if (extended) fmt::print("Try:      tunica run {}\n", (directory.path() / "extended.json").string());
  return done;
}

int discover_batch(const GlobalOptions& global, const DiscoverOptions& options) {
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
  const Session session(global);
  return run_batch({options.file, options.directory, options.share, "discoveries", global.quiet},
                   [&](const std::filesystem::path& of_case, const std::filesystem::path& results) {
                     const auto experiment = session.read(of_case / "experiment.json");
                     const auto found =
                         discovery::discover(experiment, request_of(experiment, options), session.catalogue());
                     std::filesystem::create_directories(results);
                     write_discovery(results, found, experiment, session.catalogue());
                   });
}

}  // namespace

void add_discover(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<DiscoverOptions>();
  auto* verb = app.add_subcommand("discover", "Find the terms that the energy lacks, or is made of");
  verb->add_option("experiment", options->file, "Experiment file (JSON)")->required()->type_name("EXP");
  verb->add_option("-o,--output", options->directory, "New folder for the results; results/<name>-<n> without it")
      ->type_name("DIR");
  verb->add_option("--model", options->model, "The base, instead of the file's")->type_name("NAME");
  verb->add_flag("--from-nothing", options->from_nothing, "The terms make up the whole energy; no base is kept");
  verb->add_option("--invariants", options->invariants,
                   "Only functions of these, separated by commas: I1,I2,stretches,'fibre axial'")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("INVARIANTS");
  verb->add_option("--laws", options->laws, "Only these laws, separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("LAWS");
  verb->add_option("--most-terms", options->most_terms, "The most terms; 3 without it, from nothing 4")
      ->check(CLI::Range(1, 6))
      ->type_name("N");
  verb->add_option("--most-parameters", options->most_parameters,
                   "The most parameters of the terms together; as many as it takes without it")
      ->check(CLI::Range(1, 20))
      ->type_name("N");
  verb->add_option("-j,--threads", options->threads, "Threads; all of the machine without it")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  verb->add_option("--seed", options->seed, "Root seed instead of the one in the file")
      ->check(seed_number())
      ->type_name("S");
  verb->add_option("--alpha", options->alpha, "Share of false alarms that is accepted, instead of the file's")
      ->check(CLI::Range(0.0001, 0.5))
      ->type_name("A");
  verb->add_flag("--quick", options->quick, "The alarm from linear draws only: a second instead of several");
  auto* batch =
      verb->add_flag("--batch", options->batch,
                     "EXP is a folder of folders with an experiment.json each; those with a result.json are skipped");
  verb->add_option("--shard", options->share, "With --batch: only part k of N of the folders, as 2/7")
      ->needs(batch)
      ->type_name("k/N");
  verb->add_flag("--quiet", global.quiet, "Nothing on stderr but errors");
  verb->footer(
      "Examples:\n"
      "  tunica discover experiment.json\n"
      "  tunica discover experiment.json --from-nothing -o results/a\n"
      "  tunica discover experiment.json --invariants I1,I2 --most-terms 2\n"
      "  tunica discover --batch --quick cases/\n\n"
      "Writes report.html, result.json, extended.json (the experiment with the terms: `tunica run` takes it),\n"
      "residuals.csv and input.json. Exit code 0 whatever the verdict.");
  verb->callback([&global, &action, options] {
    action = [&global, options] {
      return options->batch ? discover_batch(global, *options) : discover(global, *options);
    };
  });
}

}  // namespace tunica::app
