// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <unistd.h>

#include "answer.hpp"
#include "batch.hpp"
#include "budget/diagnosed.hpp"
#include "budget/output/outputs.hpp"
#include "calibration/examination.hpp"
#include "data/nearest.hpp"
#include "diagnosis/evidence/base_fit.hpp"
#include "diagnosis/output/outputs.hpp"
#include "discovery/output/outputs.hpp"
#include "execution/files.hpp"
#include "execution/interrupt.hpp"
#include "execution/run_directory.hpp"
#include "exit_codes.hpp"
#include "experiment/tolerance_text.hpp"
#include "finite_range.hpp"
#include "messages.hpp"
#include "report/report.hpp"
#include "stages.hpp"
#include "supervisor.hpp"
#include "text/terminal.hpp"
#include "text/wrapping.hpp"
#include "tunica/error.hpp"
#include "unfinished_results.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct DiagnoseOptions {
  std::string file, directory, share;
  unsigned threads = static_cast<unsigned>(tbb::info::default_concurrency());
  std::optional<std::uint64_t> seed;
  std::optional<double> alpha;
  std::vector<std::string> mechanisms, groups;
  std::string tolerance;
  bool quick = false, batch = false, no_discovery = false;
};

/// The file's request, with overrides from the command line.
diagnosis::Request request_of(const experiment::Experiment& experiment, const Session& session,
                              const DiagnoseOptions& options) {
  diagnosis::Request request = diagnosis::request_of(experiment);
  if (options.seed) request.seed = *options.seed;
  if (options.alpha) request.alpha = *options.alpha;
  request.quick = options.quick;
  if (!options.groups.empty()) request.groups = options.groups;
  if (!options.tolerance.empty())
    request.tolerance = {{"", experiment::tolerance_text(options.tolerance, "--tolerance")}};
  std::vector<std::string> known;
  for (const auto& [id, entry] : session.catalogue().mechanisms()) known.push_back(id);
  for (const std::string& id : options.mechanisms) {
    if (!session.catalogue().mechanisms().contains(id))
      throw InputError(fmt::format("--mechanisms: no loaded plugin provides the mechanism '{}'. {}", id,
                                   data::suggestion(id, known)));
    request.mechanisms = options.mechanisms;
  }
  return request;
}

/// The answer to Ctrl-C.
std::string interruption_message() {
  return fmt::format(
      "{}interrupted; an unfinished diagnosis leaves nothing behind. Start it again with the same command, or with "
      "--quick for a first answer\n",
      text::Terminal::of(STDERR_FILENO).redraws ? "\r\033[K" : "");
}

int diagnose(const GlobalOptions& global, const DiagnoseOptions& options) {
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
  const Session session(global);
  const auto experiment = session.read(options.file);
  const auto request = request_of(experiment, session, options);
  // Folders that are made here are removed when there are no results: after an error, or Ctrl-C.
  const std::filesystem::path requested = options.directory;
  const bool was_there = !requested.empty() && std::filesystem::exists(requested);
  const bool results_were_there = std::filesystem::exists("results");
  auto directory =
      execution::RunDirectory::create(requested.empty() ? std::nullopt : std::optional(requested), experiment.name);
  std::vector<std::filesystem::path> made;
  if (!was_there) made.push_back(directory.path());
  if (requested.empty() && !results_were_there) made.push_back(directory.path().parent_path());
  supervised::unfinished(made, directory.path());
  budget::DiagnosisAndSearch found;
  try {
    UnfinishedResults folder(made, interruption_message());
    Stages stages(global.quiet);
    found = budget::diagnosed(experiment, request, session.catalogue(), !options.no_discovery,
                              [&stages](const std::string& what, double share) { stages.tell(what, share); });
    folder.keep();
  } catch (const diagnosis::BaseFitFailure& problem) {
    say_error(fmt::format("{}. Run `{}`, which evaluates the initial point and shows what fails", problem.what(),
                          calibration::check_command(experiment, options.file)));
    return not_converged;
  }
  const execution::InterruptWatch watch;  // writing takes a moment, and is not left half done
  execution::NewResults results(directory);
  budget::write_diagnosis(directory.path(), found, experiment, session.catalogue());
  results.complete();
  const std::vector<diagnosis::Warning> warnings = found.diagnosis.warnings();
  for (const diagnosis::Warning& warning : warnings) answer("{}\n", text::hanging("warning: ", warning.text));
  if (!warnings.empty()) answer("\n");
  const auto page = report::write_report(directory.path());
  text::StyledText of_budget;
  if (found.budget)
    of_budget = found.diagnosis.analysis.alarm.raised
                    ? budget::summary(*found.budget, found.diagnosis.request.model)
                    : budget::same_model_line(*found.budget, found.diagnosis.request.model);
  text::StyledText words = diagnosis::summary(found.diagnosis, of_budget);
  if (found.discovered()) words += discovery::term_summary(*found.search);
  answer("{}\nReport:   {}\nResults:  {}\n", words.shown_on(answer_descriptor()), page.string(),
         (directory.path() / "result.json").string());
  if (found.diagnosis.explanation.mended)
    answer("Try:      tunica diagnose {}\n", (directory.path() / "mended.json").string());
  if (std::filesystem::exists(directory.path() / "extended.json"))
    answer("Try:      tunica run {}\n", (directory.path() / "extended.json").string());
  return done;
}

int diagnose_batch(const GlobalOptions& global, const DiagnoseOptions& options) {
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
  const Session session(global);
  return run_batch({options.file, options.directory, options.share, "diagnoses", global.quiet},
                   [&](const std::filesystem::path& of_case, const std::filesystem::path& results) {
                     const auto experiment = session.read(of_case / "experiment.json");
                     const auto found = budget::diagnosed(experiment, request_of(experiment, session, options),
                                                          session.catalogue(), !options.no_discovery);
                     execution::make_folder(results);
                     budget::write_diagnosis(results, found, experiment, session.catalogue());
                   });
}

}  // namespace

void add_diagnose(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<DiagnoseOptions>();
  auto* verb =
      app.add_subcommand("diagnose", "Show what the simulation gets wrong, name the cause, extend, measure the gain");
  verb->add_option("experiment", options->file, "Experiment file (JSON)")->required()->type_name("EXP");
  verb->add_option("-o,--output", options->directory, "New folder for the results; results/<name>-<n> without it")
      ->type_name("DIR");
  verb->add_option("-j,--threads", options->threads, "Threads; all of the machine without it")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  verb->add_option("--seed", options->seed, "Root seed instead of the one in the file")
      ->check(seed_number())
      ->type_name("S");
  verb->add_option("--alpha", options->alpha, "Share of false alarms that is accepted, instead of the file's")
      ->check(FiniteRange(0.0001, 0.5))
      ->type_name("A");
  verb->add_option("--tolerance", options->tolerance,
                   "What is not worth caring about, as \"2 %\" of the range, instead of the file's")
      ->type_name("SHARE");
  verb->add_option("--mechanisms", options->mechanisms, "Only these causes, names separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("MECHANISMS");
  verb->add_option("--groups", options->groups,
                   "Where causes may lie, separated by commas: material, rig, file (what the file says and is not so)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(experiment::cause_groups))
      ->type_name("GROUPS");
  verb->add_flag(
      "--quick", options->quick,
      "Linear bootstrap only, and only the likeliest causes at finite amplitude: a second instead of several");
  verb->add_flag("--no-discovery", options->no_discovery,
                 "Where the cause is unknown, do not look for terms that the energy lacks");
  auto* batch =
      verb->add_flag("--batch", options->batch,
                     "EXP is a folder of folders with an experiment.json each; those with a result.json are skipped");
  verb->add_option("--shard", options->share, "With --batch: only part k of N of the folders, as 2/7")
      ->needs(batch)
      ->type_name("k/N");
  verb->add_flag("--quiet", global.quiet, "Nothing on stderr but errors");
  verb->footer(
      "Examples:\n"
      "  tunica diagnose experiment.json\n"
      "  tunica diagnose experiment.json -o results/a --quick\n"
      "  tunica diagnose experiment.json --mechanisms fibre_dispersion,force_offset\n"
      "  tunica diagnose experiment.json --groups material,rig\n"
      "  tunica diagnose --batch --quick cases/\n"
      "  tunica diagnose --batch --quick --shard 2/7 cases/\n\n"
      "Writes report.html, result.json, extended.json (the experiment with the cause added: `tunica run` takes it),\n"
      "residuals.csv, confusability.csv and input.json. Exit code 0 whatever the verdict.");
  verb->callback([&global, &action, options] {
    action = [&global, options] {
      return options->batch ? diagnose_batch(global, *options) : diagnose(global, *options);
    };
  });
}

}  // namespace tunica::app
