// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "comparison/certify.hpp"
#include "comparison/fit_table.hpp"
#include "comparison/provenance.hpp"
#include "comparison/ranking_table.hpp"
#include "comparison/result_json.hpp"
#include "comparison/stability_report.hpp"
#include "comparison/study_tables.hpp"
#include "comparison/summary.hpp"
#include "comparison/uncertainty.hpp"
#include "comparison/wall_tables.hpp"
#include "data/nearest.hpp"
#include "execution/files.hpp"
#include "execution/interrupt.hpp"
#include "execution/run_directory.hpp"
#include "execution/runner.hpp"
#include "exit_codes.hpp"
#include "fresh_process.hpp"
#include "messages.hpp"
#include "report/report.hpp"
#include "text/lists.hpp"
#include "text/wrapping.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct RunOptions {
  std::string file, directory;
  unsigned threads = static_cast<unsigned>(tbb::info::default_concurrency());
  std::optional<std::uint64_t> seed;
  bool resume = false, certificate = true;
  std::vector<std::string> profiles;
  std::optional<std::uint64_t> bootstrap;
};

/// The seed of the command line, in the experiment and in the input.json it is documented by.
void override_seed(experiment::Experiment& experiment, std::uint64_t seed) {
  experiment.seed = seed;
  auto input = nlohmann::ordered_json::parse(experiment.input_json);
  input["seed"] = seed;
  experiment.input_json = input.dump(2) + '\n';
}

/// An empty list of names takes the next word of the command line for one: "--profiles , --quiet".
void check_names(const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (name.empty() || name.starts_with('-'))
      throw InputError(
          fmt::format("--profiles: '{}' is not the name of a parameter; expected names separated by commas, "
                      "or all, for example --profiles mu,k1",
                      name));
}

/// The same for the analysis.
void override_analysis(experiment::Experiment& experiment, const RunOptions& options) {
  auto input = nlohmann::ordered_json::parse(experiment.input_json);
  auto& analysis = experiment.analysis;
  check_names(options.profiles);
  if (!options.profiles.empty()) {
    analysis.all_profiles = options.profiles == std::vector<std::string>{"all"};
    analysis.profiles = analysis.all_profiles ? std::vector<std::string>{} : options.profiles;
    input["analysis"]["profiles"] =
        analysis.all_profiles ? nlohmann::ordered_json("all") : nlohmann::ordered_json(analysis.profiles);
  }
  if (options.bootstrap) {
    analysis.bootstrap_draws = *options.bootstrap;
    input["analysis"]["bootstrap"]["draws"] = *options.bootstrap;
  }
  experiment.input_json = input.dump(2) + '\n';
}

/// For a POSIX shell: quoted where it has to be.
std::string quoted(const std::string& word) {
  if (word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=+@%") == word.npos)
    return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// With everything that decides the result, so that it works as it is printed.
std::string resume_command(const GlobalOptions& global, const RunOptions& options,
                           const std::filesystem::path& directory) {
  std::string command = fmt::format("tunica run {} -o {} --resume", quoted(options.file), quoted(directory.string()));
  if (options.seed) command += fmt::format(" --seed {}", *options.seed);
  if (!options.profiles.empty())
    command += " --profiles " + quoted(fmt::format("{}", fmt::join(options.profiles, ",")));
  if (options.bootstrap) command += fmt::format(" --bootstrap {}", *options.bootstrap);
  if (!options.certificate) command += " --no-certificate";
  for (const auto& path : global.plugin_paths)
    command += " --plugin-path " + quoted(std::filesystem::path(path).string());
  if (global.allow_world_writable_plugins) command += " --allow-world-writable-plugins";
  return command;
}

/// Asks a process that has seen nothing of the search; the numbers it needs are in the folder.
void certify(const GlobalOptions& global, const RunOptions& options, const std::filesystem::path& directory,
             comparison::Summary& summary) {
  if (!options.certificate) return comparison::add_certificates("", "--no-certificate was given", summary);
  std::vector<std::string> arguments{"certify", directory.string(), "--quiet", "-j", std::to_string(options.threads)};
  for (const auto& path : global.plugin_paths) arguments.insert(arguments.end(), {"--plugin-path", path});
  if (global.allow_world_writable_plugins) arguments.emplace_back("--allow-world-writable-plugins");
  const Answer answer = ask_fresh_process(arguments);
  comparison::add_certificates(answer.problem.empty() ? answer.out : "", answer.problem, summary);
}

/// 1 when a run has nothing to show, broke its constraints or was given up by the failure policy.
ExitCode judge(const comparison::Summary& summary) {
  for (const auto& run : summary.runs)
    if (!run.has_result || run.status.kind() == Status::Kind::infeasible || run.given_up + run.faults > 0)
      return not_converged;
  return done;
}

std::string next_step(const comparison::Summary& summary, const std::string& file,
                      const std::filesystem::path& result) {
  const auto first = std::find_if(summary.ranking.begin(), summary.ranking.end(),
                                  [](const auto& entry) { return entry.rank.has_value(); });
  if (first == summary.ranking.end())
    return fmt::format("tunica check {}\n(evaluates the initial point and shows what fails)", file);
  return fmt::format(
      "tunica simulate {} --model {} --parameters {} -o FOLDER\n(the best fit as curves, in the form of the data)",
      file, summary.runs[first->run].model, result.string());
}

int run(const GlobalOptions& global, const RunOptions& options) {
  const Session session(global);
  auto experiment = session.read(options.file);
  if (options.seed) override_seed(experiment, *options.seed);
  if (!options.profiles.empty() || options.bootstrap) override_analysis(experiment, options);
  const auto plan = execution::make_plan(experiment, session.catalogue());
  comparison::check_analysis(plan, session.catalogue());
  const std::optional<std::filesystem::path> requested =
      options.directory.empty() ? std::nullopt : std::optional<std::filesystem::path>(options.directory);
  const auto directory = options.resume ? execution::RunDirectory::reopen(requested, experiment.name)
                                        : execution::RunDirectory::create(requested, experiment.name);
  if (!global.quiet)
    fmt::print(stderr, "{} {}: {}, {}, {}\n", options.resume ? "resuming" : "writing to", directory.path().string(),
               text::counted(plan.runs.size(), "run", "runs"), text::counted(plan.tasks.size(), "search", "searches"),
               text::counted(options.threads, "thread", "threads"));

  execution::RunSettings settings;
  settings.directory = directory.path();
  settings.threads = options.threads;
  settings.resume = options.resume;
  settings.progress = global.quiet ? execution::Progress::Style::none : execution::Progress::style_of_stderr();
  execution::Execution outcome;
  {
    const execution::InterruptWatch watch;
    outcome = execution::execute(plan, settings);
  }
  if (!outcome.write_failure.empty()) {
    say_error(fmt::format("{}. Then go on with\n  {}", outcome.write_failure,
                          resume_command(global, options, directory.path())));
    return interrupted;
  }
  if (outcome.interrupted) {
    fmt::print(stderr, "interrupted; everything so far is saved. Go on with\n  {}\n",
               resume_command(global, options, directory.path()));
    return interrupted;
  }

  const execution::InterruptWatch watch;  // a full disk is an error to report here too, not a signal to die of
  auto summary = comparison::summarise(plan, outcome.runs, session.refusals());
  const auto provenance = comparison::provenance_of(plan);
  comparison::write_fit_tables(directory.path(), plan, summary);
  comparison::write_wall_tables(directory.path(), plan, summary);
  comparison::write_stability_tables(directory.path(), plan, summary);
  comparison::write_study_tables(directory.path(), plan, outcome.runs, summary);
  execution::write_atomically(directory.path() / "result.json", comparison::result_json(summary, provenance));
  certify(global, options, directory.path(), summary);
  {
    const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
    tbb::task_arena arena(static_cast<int>(options.threads));
    arena.execute([&] {
      comparison::analyse(plan, session.catalogue(), directory.path(), execution::InterruptWatch::interrupted, summary);
    });
  }
  if (execution::InterruptWatch::interrupted()) {
    fmt::print(stderr, "interrupted; everything so far is saved. Go on with\n  {}\n",
               resume_command(global, options, directory.path()));
    return interrupted;
  }
  execution::write_atomically(directory.path() / "result.json", comparison::result_json(summary, provenance));
  const auto page = report::write_report(directory.path());
  fmt::print("{}, seed {}, tunica {}\n\n{}", data::excerpt(summary.name), experiment.seed, provenance.version,
             comparison::ranking_table(summary).shown_on(STDOUT_FILENO));
  const auto code = judge(summary);
  if (std::none_of(summary.runs.begin(), summary.runs.end(), [](const auto& entry) { return entry.has_result; }))
    say_error(fmt::format("no evaluation succeeded; the first reason: {}", summary.runs.front().status.reason()));
  const auto result = directory.path() / "result.json";
  fmt::print("\nReport:  {}\nResults: {}\n{}\n", page.string(), result.string(),
             text::hanging("Next:    ", next_step(summary, options.file, result)));
  return code;
}

}  // namespace

void add_run(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<RunOptions>();
  auto* verb = app.add_subcommand("run", "Calibrate every entry of \"runs\" and compare them");
  verb->add_option("experiment", options->file, "Experiment file (JSON)")->required()->type_name("EXP");
  verb->add_option("-o,--output", options->directory, "New folder for the results; results/<name>-<n> without it")
      ->type_name("DIR");
  verb->add_option("-j,--threads", options->threads,
                   "Threads, for realisations and population members together; all of the machine without it")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  verb->add_option("--seed", options->seed, "Root seed instead of the one in the file")
      ->check(seed_number())
      ->type_name("S");
  verb->add_flag("--resume", options->resume, "Go on with an interrupted run, to the identical result");
  verb->add_option("--profiles", options->profiles,
                   "Profile likelihood of these parameters, names separated by commas, or all")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAMES");
  verb->add_option("--bootstrap", options->bootstrap, "Residual bootstrap with so many draws, from 40")
      ->check(CLI::Range(40, 1000000))
      ->type_name("N");
  verb->add_flag("!--no-certificate", options->certificate,
                 "Do not evaluate the best points and their neighbours again in a fresh process");
  verb->add_flag("--quiet", global.quiet, "Nothing on stderr but errors");
  verb->footer(
      "Examples:\n"
      "  tunica run experiment.json\n"
      "  tunica run experiment.json -o results/a -j 4 --seed 7\n"
      "  tunica run experiment.json -o results/a --resume\n"
      "  tunica run experiment.json --profiles all --bootstrap 200\n\n"
      "Writes result.json, evaluations.csv (live), fit_<test>.csv, ranking.csv, realisations.csv, convergence.csv,\n"
      "performance_profile.csv, data_profile.csv, input.json, run.log and checkpoint.json.");
  verb->callback([&global, &action, options] { action = [&global, options] { return run(global, *options); }; });
}

}  // namespace tunica::app
