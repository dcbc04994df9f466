// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <unistd.h>

#include "answer.hpp"
#include "cohort/results.hpp"
#include "cohort/results_folder.hpp"
#include "cohort/shares.hpp"
#include "cohort/study_output.hpp"
#include "cohort/tables.hpp"
#include "cohort_cluster.hpp"
#include "execution/files.hpp"
#include "execution/interrupt.hpp"
#include "exit_codes.hpp"
#include "messages.hpp"
#include "stages.hpp"
#include "supervisor.hpp"
#include "text/aside.hpp"
#include "text/shell.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct CohortOptions {
  std::string file, directory, share;
  unsigned threads = static_cast<unsigned>(tbb::info::default_concurrency());
  bool reports = false, no_reports = false, diagnose = false;
};

/// The command that goes on with it, with the options that decide the result.
std::string command(const GlobalOptions& global, const std::string& verb, const CohortOptions& options,
                    const std::filesystem::path& results) {
  std::vector<std::string> words{"tunica", "cohort"};
  if (!verb.empty()) words.push_back(verb);
  words.insert(words.end(), {options.file, "-o", results.string()});
  if (options.diagnose) words.emplace_back("--diagnose");
  if (!options.share.empty() && verb.empty()) words.insert(words.end(), {"--shard", options.share});
  const auto plugins = plugin_words(global);
  words.insert(words.end(), plugins.begin(), plugins.end());
  return text::quoted(words);
}

int merge(const GlobalOptions& global, const Session& session, const CohortOptions& options,
          const cohort::Opened& opened, const std::filesystem::path& results) {
  const auto found = cohort::collect(opened.cohort, opened.table, opened.pattern, session.catalogue(), results);
  if (!found.missing.empty())
    throw InputError(
        fmt::format("{}: {} of {} specimens have no result yet, or a damaged one; the first is '{}'. Run "
                    "`{}`, which makes what is missing",
                    results.string(), found.missing.size(), opened.table.specimens.size(),
                    opened.table.specimens[found.missing.front()].id, command(global, "", options, results)));
  cohort::Study study;
  {
    Stages stages(global.quiet);
    study = cohort::make_results(opened, found, session.catalogue(), results,
                                 [&stages](const std::string& what, double share) { stages.tell(what, share); });
  }
  answer("{}{}\nReport:   {}\nResults:  {}\n", cohort::outcome_words(opened.table, found),
         cohort::study_words(opened.table, study), (results / "report.html").string(),
         (results / "result.json").string());
  if (study.diagnosis && !study.diagnosis->extended.empty())
    answer("Try:      {}\n", text::quoted({"tunica", "cohort", (results / "extended_cohort.json").string()}));
  return found.count(cohort::Outcome::fitted) > 0 ? done : not_converged;
}

int fit_and_merge(const GlobalOptions& global, const CohortOptions& options) {
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
  const cohort::Share share = options.share.empty() ? cohort::Share{} : cohort::parse_share(options.share);
  const Session session(global);
  const cohort::Opened opened(options.file, options.diagnose);
  const auto begun = supervised::resumable_folder();
  const auto results = cohort::results_folder(begun.empty() ? options.directory : begun.string(), opened.cohort.name);
  supervised::resumable_in(results);
  execution::write_atomically(results / "cohort.json", opened.cohort.text);
  cohort::FitSettings settings;
  settings.results = results;
  settings.reports = options.reports || (!options.no_reports && opened.table.specimens.size() <= cohort::most_reports);
  settings.refusals = session.refusals();
  std::mutex saying;
  settings.noticed = [&saying](const std::string& sentence) {
    const std::lock_guard lock(saying);
    say_wrapped_warning(sentence);
  };
  settings.interrupted = [] { return execution::InterruptWatch::interrupted(); };
  cohort::ShareOutcome outcome;
  try {
    const execution::InterruptWatch watch;
    Stages stages(global.quiet);
    outcome = cohort::fit_share(opened.cohort, opened.table, opened.pattern, session.catalogue(), settings, share,
                                [&](std::size_t finished, std::size_t of) {
                                  stages.tell(fmt::format("{} of {} specimens", finished, of),
                                              static_cast<double>(finished) / static_cast<double>(of));
                                });
  } catch (const execution::WriteFailure& problem) {
    say_error(fmt::format("{}. Then go on with\n  {}", problem.what(), command(global, "", options, results)));
    return interrupted;
  }
  if (outcome.interrupted) {
    text::aside("interrupted; the specimens that are done are saved. Go on with\n  {}\n",
                command(global, "", options, results));
    return interrupted;
  }
  if (!options.share.empty()) {  // one of one, too: its limits on a cluster are those of fits
    answer("shard {} of {}: {} of {} specimens fitted\nMerge:    {}\n", share.part, share.of, outcome.fitted,
           outcome.specimens, command(global, "merge", options, results));
    return done;
  }
  return merge(global, session, options, opened, results);
}

int merge_only(const GlobalOptions& global, const CohortOptions& options) {
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
  const Session session(global);
  return merge(global, session, options, cohort::Opened(options.file, options.diagnose), options.directory);
}

void add_common(CLI::App& verb, CohortOptions& options, bool directory_required) {
  verb.add_option("cohort", options.file, "Cohort file (JSON)")->type_name("FILE");
  auto* directory = verb.add_option("-o,--output", options.directory,
                                    "Folder for the results; results/<name>-<n> without it. One of an earlier start of "
                                    "the same cohort is gone on with")
                        ->type_name("DIR");
  if (directory_required) directory->required();
  verb.add_flag("--diagnose", options.diagnose,
                "Say what the model gets wrong in all specimens; the key \"diagnosis\" of the file does the same");
  verb.add_option("-j,--threads", options.threads, "Threads; all of the machine without it")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
}

}  // namespace

void add_cohort(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<CohortOptions>();
  auto* verb = app.add_subcommand("cohort", "Fit many specimens, and say what they have in common");
  add_common(*verb, *options, false);
  verb->add_option("--shard", options->share, "Only part k of N, as 2/7; merge them when all are done")
      ->type_name("k/N");
  auto* reports = verb->add_flag("--reports", options->reports, "A report.html for each specimen, however many");
  verb->add_flag("--no-reports", options->no_reports, "No report.html for single specimens")->excludes(reports);
  verb->add_flag("--quiet", global.quiet, "Nothing on stderr but errors");
  verb->require_subcommand(0, 1);
  verb->footer(
      "Examples:\n"
      "  tunica cohort cohort.json -o results/aortas\n"
      "  tunica cohort cohort.json -o results/aortas --shard 2/7\n"
      "  tunica cohort merge cohort.json -o results/aortas\n\n"
      "What the file holds: docs/cohort.md. A specimen that cannot be read or fitted is listed with its reason, and "
      "the\n"
      "others go on. The same command again makes only what is missing or has changed.");
  auto* merging = verb->add_subcommand("merge", "Make the results of the cohort from what its shards have left");
  add_common(*merging, *options, true);
  merging->callback(
      [&global, &action, options] { action = [&global, options] { return merge_only(global, *options); }; });
  add_cohort_cluster(*verb, global, action);
  verb->callback([&global, &action, options, verb] {
    if (!verb->get_subcommands().empty()) return;
    if (options->file.empty()) throw CLI::RequiredError("FILE");
    action = [&global, options] { return fit_and_merge(global, *options); };
  });
}

}  // namespace tunica::app
