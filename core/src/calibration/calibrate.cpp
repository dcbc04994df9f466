// SPDX-License-Identifier: Apache-2.0
#include "calibration/calibrate.hpp"

#include <algorithm>
#include <future>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "comparison/certify.hpp"
#include "comparison/fit_table.hpp"
#include "comparison/result_json.hpp"
#include "comparison/stability_report.hpp"
#include "comparison/study_tables.hpp"
#include "comparison/uncertainty.hpp"
#include "comparison/wall_tables.hpp"
#include "execution/checkpoint.hpp"
#include "execution/files.hpp"
#include "execution/interrupt.hpp"
#include "execution/memory_need.hpp"
#include "execution/run_directory.hpp"
#include "execution/runner.hpp"
#include "execution/shards.hpp"
#include "execution/thinning.hpp"
#include "report/report.hpp"
#include "tunica/error.hpp"

namespace tunica::calibration {

namespace {

/// Whether a folder holds only the files of a run that ended before its first checkpoint: they contain no evaluation.
bool holds_a_beginning(const std::filesystem::path& folder) {
  return std::ranges::all_of(std::filesystem::directory_iterator(folder), [](const auto& entry) {
    const std::string name = entry.path().filename().string();
    if (name == "parts") return std::filesystem::is_empty(entry.path());
    if (name != "evaluations.csv")
      return name == "run.log" || name == "input.json" || name.starts_with("input.json.new-") ||
             name.starts_with("checkpoint.json.new-");
    const std::string rows = execution::read_text(entry.path());
    return std::ranges::count(rows, '\n') <= 1;
  });
}

void clear(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) std::filesystem::remove_all(entry.path());
}

/// The folder of an interrupted run. One that was killed before its first checkpoint begins again.
execution::RunDirectory folder_to_go_on(const std::optional<std::filesystem::path>& directory,
                                        const std::string& name) {
  auto held = execution::RunDirectory::reopen(directory, name);
  for (const char* own : {"parts", "shards"}) static_cast<void>(execution::own_folder(held.path() / own));
  if (holds_a_beginning(held.path())) clear(held.path());
  return held;
}

/// The folder of a part. One that was killed before its first checkpoint begins again.
execution::RunDirectory folder_of_part(const std::filesystem::path& directory, const execution::Share& share,
                                       const std::string& name) {
  if (std::filesystem::exists(directory / "checkpoint.json"))
    throw InputError(
        fmt::format("{}: holds a run that is not in parts, or whose parts are merged; name another folder with -o",
                    directory.string()));
  const auto folder = execution::shard_folder(directory, share);
  if (execution::make_folders(folder)) return execution::RunDirectory::create(folder, name);  // says what is wrong
  auto held = execution::RunDirectory::reopen(folder, name);
  if (!std::filesystem::exists(folder / "checkpoint.json")) clear(folder);
  return held;
}

/// The folder of this run, or of this part of it.
execution::RunDirectory folder_of(const Options& options, const std::string& name) {
  if ((options.share || options.merge) && !options.directory)
    throw InputError("parts of a run need a folder that all of them know; name it with -o");
  if (options.share) return folder_of_part(*options.directory, *options.share, name);
  if (options.merge) return execution::RunDirectory::reopen(options.directory, name);
  return options.resume ? folder_to_go_on(options.directory, name)
                        : execution::RunDirectory::create(options.directory, name);
}

execution::Execution search(const execution::Plan& plan, const std::filesystem::path& directory, const Options& options,
                            bool resume) {
  const execution::InterruptWatch watch;
  execution::RunSettings settings;
  settings.directory = directory;
  settings.threads = options.threads;
  settings.resume = resume;
  settings.share = options.share.value_or(execution::Share{});
  settings.progress = options.progress;
  settings.told = options.told;
  settings.noticed = options.noticed;
  return execution::execute(plan, settings);
}

void write_tables(const execution::Plan& plan, const std::vector<execution::RunResult>& results,
                  const std::filesystem::path& directory, const comparison::Summary& summary) {
  comparison::write_fit_tables(directory, plan, summary);
  comparison::write_wall_tables(directory, plan, summary);
  comparison::write_stability_tables(directory, plan, summary);
  comparison::write_study_tables(directory, plan, results, summary);
}

/// A temporary file that is always removed, even after an error.
struct TemporaryFile {
  const std::filesystem::path path;

  explicit TemporaryFile(std::filesystem::path file) : path(std::move(file)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code left;  // of one that cannot be removed the results do not depend
    std::filesystem::remove(path, left);
  }
};

/// The fresh process knows the experiment and the best points, nothing else.
Certified certified(const std::filesystem::path& directory, const Options& options,
                    const comparison::Summary& summary) {
  if (!options.certify) return {"", "--no-certificate was given"};
  const TemporaryFile points(directory / "best_points.json");
  execution::write_atomically(points.path, comparison::best_points_json(summary));
  return options.certify(directory, points.path);
}

/// The fresh process runs while the tables are written, if a thread is free.
void write_tables_and_certify(const execution::Plan& plan, const std::vector<execution::RunResult>& results,
                              const std::filesystem::path& directory, const Options& options,
                              comparison::Summary& summary) {
  auto certificate = std::async(options.threads > 1 ? std::launch::async : std::launch::deferred,
                                [&] { return certified(directory, options, summary); });
  write_tables(plan, results, directory, summary);
  const Certified found = certificate.get();
  if (comparison::add_certificates(found.answer, found.missing, summary))
    write_tables(plan, results, directory, summary);  // of another ranking
}

void analyse(const execution::Plan& plan, const plugins::Catalogue& catalogue, const std::filesystem::path& directory,
             const Options& options, comparison::Summary& summary) {
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
  tbb::task_arena arena(static_cast<int>(options.threads));
  arena.execute([&] {
    comparison::analyse(plan, catalogue, directory, execution::InterruptWatch::interrupted, options.concluding,
                        summary);
  });
}

/// From the searches to the results.
void conclude(const execution::Plan& plan, const std::vector<execution::RunResult>& found,
              const plugins::Catalogue& catalogue, const Options& options, Outcome& outcome) {
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
  const execution::InterruptWatch watch;  // a full disk is an error to report here too, not a signal to die of
  outcome.summary = comparison::summarise(plan, found, options.refusals, options.concluding);
  outcome.provenance = comparison::provenance_of(plan);
  if (options.merge)  // the searches were others'
    if (auto level = execution::vector_level_of(outcome.directory); !level.empty())
      outcome.provenance.vector_level = std::move(level);
  if (options.concluding) options.concluding("tables and certificate");
  write_tables_and_certify(plan, found, outcome.directory, options, outcome.summary);
  analyse(plan, catalogue, outcome.directory, options, outcome.summary);
  if (execution::InterruptWatch::interrupted()) {
    outcome.ending = Outcome::Ending::interrupted;
    return;
  }
  outcome.result = outcome.directory / "result.json";
  execution::write_atomically(outcome.result, comparison::result_json(outcome.summary, outcome.provenance));
  outcome.report = report::write_report(outcome.directory);
  if (plan.experiment->kept_evaluations == experiment::KeptEvaluations::improvements)
    execution::thin_evaluations(plan, outcome.directory);
}

void refuse_runs_without_data(const execution::Plan& plan) {
  for (const execution::PlannedRun& run : plan.runs)
    if (std::none_of(run.entry->tests.begin(), run.entry->tests.end(),
                     [&](const std::string& name) { return plan.experiment->test(name).measured; }))
      throw InputError(
          fmt::format("run {}: no test has measured values, so there is nothing to fit. Map a measured "
                      "quantity in \"columns\", or predict with `tunica simulate`.",
                      run.label));
}

}  // namespace

bool Outcome::sound() const {
  return std::all_of(summary.runs.begin(), summary.runs.end(), [](const comparison::RunSummary& run) {
    return comparison::succeeded(comparison::ending_of(run)) && run.given_up + run.faults == 0;
  });
}

Outcome calibrate(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                  const Options& options) {
  const auto plan = execution::make_plan(experiment, catalogue);
  refuse_runs_without_data(plan);
  execution::refuse_excess(execution::memory_need(plan, options.threads), execution::memory_limit());
  comparison::check_analysis(plan, catalogue);
  const auto folder = folder_of(options, experiment.name);
  Outcome outcome;
  outcome.directory = folder.path();
  try {
    const bool resume = options.merge || (options.resume && !std::filesystem::is_empty(folder.path())) ||
                        (options.share && std::filesystem::exists(folder.path() / "checkpoint.json"));
    if (options.merge) execution::gather_shards(plan, folder.path(), options.noticed);
    if (options.started) options.started({plan, outcome.directory});
    std::function<void()> leave;
    if (options.abandon) leave = [&options, directory = outcome.directory] { options.abandon(directory); };
    const execution::InterruptLimit limit(std::move(leave));
    const auto found = search(plan, outcome.directory, options, resume);
    outcome.write_failure = found.write_failure;
    outcome.ending = !found.write_failure.empty() ? Outcome::Ending::write_failure
                     : found.interrupted          ? Outcome::Ending::interrupted
                     : options.share              ? Outcome::Ending::part_finished
                                                  : Outcome::Ending::finished;
    if (outcome.ending == Outcome::Ending::finished) conclude(plan, found.runs, catalogue, options, outcome);
  } catch (const execution::WriteFailure& problem) {
    outcome.write_failure = problem.what();
    outcome.ending = Outcome::Ending::write_failure;
  }
  return outcome;
}

}  // namespace tunica::calibration
