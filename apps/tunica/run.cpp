// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/info.h>
#include <unistd.h>

#include "answer.hpp"
#include "calibration/calibrate.hpp"
#include "calibration/examination.hpp"
#include "calibration/overrides.hpp"
#include "comparison/ranking_table.hpp"
#include "data/nearest.hpp"
#include "diagnosis/evidence/tolerance.hpp"
#include "diagnosis/request.hpp"
#include "execution/checkpoint.hpp"
#include "execution/shards.hpp"
#include "exit_codes.hpp"
#include "experiment/limits.hpp"
#include "fresh_process.hpp"
#include "messages.hpp"
#include "stages.hpp"
#include "supervisor.hpp"
#include "text/aside.hpp"
#include "text/lists.hpp"
#include "text/misfit_words.hpp"
#include "text/shell.hpp"
#include "text/terminal.hpp"
#include "text/wrapping.hpp"
#include "tunica/detail/vector_level.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

/// Shorter steps after the searches show no progress.
constexpr auto quick_step = std::chrono::seconds(2);

struct RunOptions {
  std::string file, directory, share;
  unsigned threads = static_cast<unsigned>(tbb::info::default_concurrency());
  bool resume = false, merge = false, certificate = true;
  calibration::Overrides overrides;
};

/// An empty list of names takes the next word of the command line for one: "--profiles , --quiet".
void check_names(const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (name.empty() || name.starts_with('-'))
      throw InputError(
          fmt::format("--profiles: '{}' is not the name of a parameter; expected names separated by commas, "
                      "or all, for example --profiles mu,k1",
                      name));
}

/// With every option that affects the result, so the printed command works unchanged.
std::string command(const GlobalOptions& global, const RunOptions& options, const std::filesystem::path& directory,
                    const std::vector<std::string>& how) {
  std::vector<std::string> words{"tunica", "run", options.file, "-o", directory.string()};
  words.insert(words.end(), how.begin(), how.end());
  const auto& [seed, profiles, draws, posterior, kept, paired, discrepancy] = options.overrides;
  if (seed) words.insert(words.end(), {"--seed", fmt::format("{}", *seed)});
  if (!profiles.empty()) words.insert(words.end(), {"--profiles", fmt::format("{}", fmt::join(profiles, ","))});
  if (draws) words.insert(words.end(), {"--bootstrap", fmt::format("{}", *draws)});
  if (posterior) words.push_back(fmt::format("--posterior={}", *posterior));
  if (discrepancy) words.emplace_back("--discrepancy");
  if (!kept.empty()) words.insert(words.end(), {"--keep-evaluations", kept});
  if (paired) words.emplace_back("--paired-starts");
  if (!options.certificate) words.emplace_back("--no-certificate");
  if (options.threads != RunOptions().threads) words.insert(words.end(), {"-j", std::to_string(options.threads)});
  const auto plugins = plugin_words(global);
  words.insert(words.end(), plugins.begin(), plugins.end());
  return text::quoted(words);
}

std::string resume_command(const GlobalOptions& global, const RunOptions& options,
                           const std::filesystem::path& directory) {
  return options.share.empty() ? command(global, options, directory, {"--resume"})
                               : command(global, options, options.directory, {"--shard", options.share});
}

void say_interrupted(const GlobalOptions& global, const RunOptions& options, const std::filesystem::path& directory) {
  if (!global.quiet && text::Terminal::of(STDERR_FILENO).redraws) text::aside_raw("\r\033[K");
  text::aside("interrupted; everything so far is saved. Go on with\n  {}\n",
              resume_command(global, options, directory));
}

/// Asks a process that has seen nothing of the search; the numbers it needs are in the folder.
calibration::Certified certify(const GlobalOptions& global, unsigned threads, const std::filesystem::path& directory,
                               const std::filesystem::path& points) {
  std::vector<std::string> arguments{"certify",       directory.string(), "--quiet", "-j", std::to_string(threads),
                                     "--best-points", points.string()};
  const auto plugins = plugin_words(global);
  arguments.insert(arguments.end(), plugins.begin(), plugins.end());
  Answer answer = ask_fresh_process(arguments);
  if (!answer.problem.empty()) return {"", std::move(answer.problem)};
  return {std::move(answer.out), ""};
}

/// Whether a diagnosis of the file would explain this fit: it takes the first run of the model, without constraints.
bool is_for_diagnosis(const comparison::RunSummary& best, const experiment::Experiment& experiment) {
  if (!best.size || !best.converged) return false;
  const bool misses = best.size->rms > best.tolerance.value_or(diagnosis::Tolerance{}.share);
  if (!misses && !(best.misfit && best.misfit->contradicts())) return false;
  if (best.stability && !best.stability->imposed.empty()) return false;
  const std::string model = diagnosis::request_of(experiment).model;
  const experiment::RunEntry* const diagnosed = diagnosis::run_of_model(experiment, model);
  return model == best.model && diagnosed != nullptr && diagnosed->tests == best.tests;
}

std::string next_step(const GlobalOptions& global, const comparison::Summary& summary,
                      const experiment::Experiment& experiment, const std::string& file,
                      const std::filesystem::path& result) {
  const auto first = std::find_if(summary.ranking.begin(), summary.ranking.end(),
                                  [](const auto& entry) { return entry.rank.has_value(); });
  if (first == summary.ranking.end())
    return calibration::check_command(experiment, file) + "\n(evaluates the initial point and shows what fails)";
  const comparison::RunSummary& best = summary.runs[first->run];
  const auto spoken = [&global](std::vector<std::string> words) {
    const auto plugins = plugin_words(global);
    words.insert(words.end(), plugins.begin(), plugins.end());
    return text::quoted(words);
  };
  if (is_for_diagnosis(best, experiment))
    return fmt::format("{}\n(what takes the misfit of {} of the range)", spoken({"tunica", "diagnose", file}),
                       text::percent(best.size->rms));
  return fmt::format("{} -o FOLDER\n(the best fit as curves, in the form of the data)",
                     spoken({"tunica", "simulate", file, "--model", best.model, "--parameters", result.string()}));
}

calibration::Options options_of(const GlobalOptions& global, const RunOptions& options, const Session& session) {
  calibration::Options result;
  if (!options.directory.empty()) result.directory = options.directory;
  result.resume = options.resume;
  result.merge = options.merge;
  if (!options.share.empty()) result.share = execution::parse_share(options.share);
  result.threads = options.threads;
  result.progress = global.quiet ? execution::Progress::Style::none : execution::Progress::style_of_stderr();
  result.refusals = session.refusals();
  result.noticed = [](const std::string& sentence) { say_wrapped_warning(sentence); };
  if (options.certificate)
    result.certify = [&global, &options](const std::filesystem::path& directory, const std::filesystem::path& points) {
      return certify(global, options.threads, directory, points);
    };
  result.abandon = [&global, &options](const std::filesystem::path& directory) {
    say_interrupted(global, options, directory);
    ::_exit(interrupted);
  };
  result.started = [&global, &options](const calibration::Start& start) {
    supervised::resumable_in(start.directory);
    if (!global.quiet && !supervised::successor())
      text::aside("{} {}: {}, {}, {}\n", options.resume ? "resuming" : "writing to", start.directory.string(),
                  text::counted(start.plan.runs.size(), "run", "runs"),
                  text::counted(start.plan.tasks.size(), "search", "searches"),
                  text::counted(options.threads, "thread", "threads"));
  };
  return result;
}

void print(const GlobalOptions& global, const calibration::Outcome& outcome, const experiment::Experiment& experiment,
           const std::string& file) {
  const auto& runs = outcome.summary.runs;
  answer("{}, seed {}, tunica {}\n\n{}", data::excerpt(outcome.summary.name), experiment.seed,
         outcome.provenance.version, comparison::ranking_table(outcome.summary).shown_on(answer_descriptor()));
  if (std::none_of(runs.begin(), runs.end(), [](const auto& entry) { return entry.has_result; }))
    say_error(fmt::format("no evaluation succeeded; the first reason: {}", runs.front().status.reason()));
  answer("\nReport:  {}\nResults: {}\n{}\n", outcome.report.string(), outcome.result.string(),
         text::hanging("Next:    ", next_step(global, outcome.summary, experiment, file, outcome.result)));
}

/// Resumes work that an earlier process began. A shard resumes its own folder itself.
RunOptions taken_up(RunOptions options) {
  const auto folder = supervised::resumable_folder();
  if (folder.empty() || !options.share.empty()) return options;
  options.directory = folder;
  options.resume = true;
  options.merge = false;
  return options;
}

/// A run goes on with the vector instructions that it was begun with, unless the user states others: the result is the
/// identical one. To be called before a library asks for the level.
void take_level_of(const RunOptions& options) {
  const bool part = !options.share.empty();
  if (options.directory.empty() || (!options.resume && !part)) return;
  std::filesystem::path folder = options.directory;
  if (part) folder = execution::shard_folder(folder, execution::parse_share(options.share));
  const std::string level = execution::vector_level_of(folder);
  const auto known = detail::vector_level_called(level.c_str());
  if (known && *known <= detail::best_vector_level()) ::setenv(detail::vector_level_variable, level.c_str(), 0);
}

int run(const GlobalOptions& global, const RunOptions& asked) {
  const RunOptions options = taken_up(asked);
  take_level_of(options);
  const Session session(global);
  auto experiment = session.read(options.file);
  check_names(options.overrides.profiles);
  calibration::apply(options.overrides, session.catalogue(), experiment);
  auto how = options_of(global, options, session);
  std::optional<Stages> stages;
  how.concluding = [&](const std::string& what) {
    if (!stages) stages.emplace(global.quiet, quick_step);
    stages->tell("after the searches: " + what, {});
  };
  const auto outcome = calibration::calibrate(experiment, session.catalogue(), how);
  stages.reset();
  switch (outcome.ending) {
    case calibration::Outcome::Ending::write_failure:
      say_error(fmt::format("{}. Then go on with\n  {}", outcome.write_failure,
                            resume_command(global, options, outcome.directory)));
      return interrupted;
    case calibration::Outcome::Ending::interrupted:
      say_interrupted(global, options, outcome.directory);
      return interrupted;
    case calibration::Outcome::Ending::part_finished:
      answer("shard {} is done\nMerge:    {}\n", options.share,
             command(global, options, options.directory, {"--merge"}));
      return done;
    case calibration::Outcome::Ending::finished:
      break;
  }
  print(global, outcome, experiment, options.file);
  return outcome.sound() ? done : not_converged;
}

}  // namespace

void add_run(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<RunOptions>();
  auto* verb = app.add_subcommand("run", "Calibrate every entry of \"runs\" and compare them");
  verb->add_option("experiment", options->file, "Experiment file (JSON)")->required()->type_name("EXP");
  verb->add_option("-o,--output", options->directory, "New folder for the results (default: results/<name>-<n>)")
      ->type_name("DIR");
  verb->add_option("-j,--threads", options->threads,
                   "Threads for realisations and population members together (default: all of the machine)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  verb->add_option("--seed", options->overrides.seed, "Root seed in place of the one in the file")
      ->check(seed_number())
      ->type_name("S");
  verb->add_flag("--paired-starts", options->overrides.paired_starts,
                 "Begin runs of the same parameters and bounds at the same points, to compare optimizers");
  auto* resume = verb->add_flag("--resume", options->resume, "Resume an interrupted run; the result is identical");
  auto* shard = verb->add_option("--shard", options->share,
                                 "Only part k of N of the realisations, as 2/7; killed and repeated at will")
                    ->excludes(resume)
                    ->type_name("k/N");
  verb->add_flag("--merge", options->merge, "Make the results from what the shards in DIR have left")
      ->excludes(resume)
      ->excludes(shard);
  verb->add_option("--profiles", options->overrides.profiles,
                   "Profile the likelihood of these parameters: names separated by commas, or all")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAMES");
  verb->add_option("--bootstrap", options->overrides.bootstrap_draws,
                   "Residual bootstrap with this many draws (at least 40)")
      ->check(CLI::Range(40, 1000000))
      ->type_name("N");
  verb->add_flag_function(
      "--posterior",
      [options](std::int64_t draws) {  // 1 where no number is given
        options->overrides.posterior_draws = draws == 1 ? experiment::limits::usual_posterior_draws
                                                        : static_cast<std::uint64_t>(std::max(draws, std::int64_t{0}));
      },
      "Draw from the posterior of the parameters, 4000 times; --posterior=20000 for another number");
  verb->add_flag("--discrepancy", options->overrides.discrepancy,
                 "Let the posterior allow for a smooth misfit of unknown size that the model does not explain");
  verb->add_option("--keep-evaluations", options->overrides.keep_evaluations,
                   "Rows of evaluations.csv once the results are written: all, or improvements of the best point only")
      ->type_name("all|improvements");
  verb->add_flag("!--no-certificate", options->certificate,
                 "Do not check the best points and their neighbours in a fresh process");
  verb->add_flag("--quiet", global.quiet, "Print only errors on stderr");
  verb->footer(
      "Examples:\n"
      "  tunica run experiment.json\n"
      "  tunica run experiment.json -o results/a -j 4 --seed 7\n"
      "  tunica run experiment.json -o results/a --resume\n"
      "  tunica run experiment.json --profiles all --bootstrap 200\n"
      "  tunica run experiment.json -o results/a --resume --posterior\n"
      "  tunica run experiment.json -o results/a --shard 2/7\n"
      "  tunica run experiment.json -o results/a --merge\n\n"
      "Writes result.json, evaluations.csv (live), fit_<test>.csv, ranking.csv, realisations.csv, convergence.csv,\n"
      "performance_profile.csv, data_profile.csv, input.json, run.log and checkpoint.json.");
  verb->callback([&global, &action, options] { action = [&global, options] { return run(global, *options); }; });
}

}  // namespace tunica::app
