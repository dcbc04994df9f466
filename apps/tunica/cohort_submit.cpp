// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

#include "answer.hpp"
#include "cluster/command.hpp"
#include "cluster/estimate.hpp"
#include "cluster/overview.hpp"
#include "cohort/presence.hpp"
#include "cohort/results_folder.hpp"
#include "cohort_cluster.hpp"
#include "execution/files.hpp"
#include "exit_codes.hpp"
#include "text/shell.hpp"
#include "tunica/error.hpp"

namespace tunica::app {

namespace {

/// Of a Slurm that does not say: its default MaxArraySize is 1001.
constexpr std::size_t usual_largest_index = 1000;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

std::size_t number_missing(const std::vector<char>& missing) {
  return static_cast<std::size_t>(std::count(missing.begin(), missing.end(), 1));
}

/// Every entry of TUNICA_PLUGIN_PATH, absolute: a job stands in another folder.
std::string absolute_plugin_path() {
  const char* variable = std::getenv("TUNICA_PLUGIN_PATH");
  if (!variable) return {};
  std::istringstream entries(variable);
  std::string path;
  for (std::string entry; std::getline(entries, entry, ':');)
    if (!entry.empty())
      path += (path.empty() ? "" : ":") + std::filesystem::absolute(entry).lexically_normal().string();
  return path;
}

cluster::Invocation invocation(const GlobalOptions& global, const ClusterOptions& options,
                               const ClusterCohort& cohort) {
  cluster::Invocation call;
  call.program = std::filesystem::read_symlink("/proc/self/exe");
  for (const auto& path : global.plugin_paths)
    call.options.insert(call.options.end(),
                        {"--plugin-path", std::filesystem::absolute(path).lexically_normal().string()});
  if (global.allow_world_writable_plugins) call.options.push_back("--allow-world-writable-plugins");
  call.plugin_path = absolute_plugin_path();
  call.cohort = cohort.file;
  call.results = cohort.results;
  if (options.reports) call.shard_options.push_back("--reports");
  if (options.no_reports) call.shard_options.push_back("--no-reports");
  return call;
}

/// The pilot is a shard like those of the queue, of few specimens and in a process of its own, whose memory can be
/// measured. Its records stay: nothing is fitted twice. What it fitted is no longer missing.
cluster::Pilot run_pilot(const cluster::Invocation& call, const ClusterOptions& options, const ClusterCohort& cohort,
                         std::vector<char>& missing) {
  const std::size_t wanted = std::max<std::size_t>(options.pilot, options.threads);
  const std::size_t shares = (missing.size() + wanted - 1) / wanted;
  const auto progress = cohort::progress_of_shares(missing, shares);
  const cohort::Share share =
      std::max_element(progress.begin(), progress.end(), [](const auto& one, const auto& other) {
        return one.missing < other.missing;
      })->share;
  std::vector<std::string> words{call.program.string()};
  words.insert(words.end(), call.options.begin(), call.options.end());
  words.insert(words.end(), {"cohort", cohort.file.string(), "-o", cohort.results.string(), "--quiet", "--shard",
                             fmt::format("{}/{}", share.part, share.of), "--threads", std::to_string(options.threads)});
  words.insert(words.end(), call.shard_options.begin(), call.shard_options.end());
  const cluster::Ended ended = cluster::run_command(words);
  if (!ended.well())
    throw InputError(fmt::format(
        "the pilot ended with code {}: {}. Nothing was submitted, for each shard would end so. Run it by itself "
        "to see more: `{}`",
        ended.code, cluster::last_line(ended.err), text::quoted(words)));
  cluster::Pilot pilot;
  double sum = 0;
  std::string reason;
  for (std::size_t k = 0; k < missing.size(); ++k) {
    if (!share.holds(k) || !missing[k]) continue;
    const auto record = cohort::stored_record(cohort.results, cohort.table.specimens[k]);
    missing[k] = 0;
    if (!record) continue;
    if (record->outcome != cohort::Outcome::fitted) reason = fmt::format("{}: {}", record->id, record->reason);
    if (record->outcome == cohort::Outcome::unreadable) continue;
    ++pilot.specimens;
    sum += record->seconds;
    pilot.longest_seconds = std::max(pilot.longest_seconds, record->seconds);
  }
  if (pilot.specimens == 0)
    throw InputError(
        fmt::format("the pilot could fit none of its specimens; {}. Mend the files, or say --shards, --time "
                    "and --memory, so that no pilot is needed",
                    reason));
  pilot.mean_seconds = sum / static_cast<double>(pilot.specimens);
  const double side_by_side = static_cast<double>(std::min<std::size_t>(options.threads, pilot.specimens));
  pilot.start_seconds = std::max(0.0, ended.seconds - sum / side_by_side);
  pilot.peak_bytes = ended.peak_bytes;
  return pilot;
}

std::string describe_pilot(const cluster::Pilot& pilot) {
  return fmt::format(
      "Pilot:    {} specimens took {:.2g} s each, {:.2g} s at most; {:.2g} s to start; {} MiB of memory\n",
      pilot.specimens, pilot.mean_seconds, pilot.longest_seconds, pilot.start_seconds, pilot.peak_bytes >> 20);
}

/// Number of shards and their limits: as the user set them, else from a pilot.
cluster::Wishes plan(const ClusterOptions& options, const ClusterCohort& cohort, const cluster::Invocation& call,
                     std::vector<char>& missing, double scan_seconds) {
  const std::size_t largest = cluster::slurm::largest_index().value_or(usual_largest_index);
  const std::size_t specimens = missing.size();
  if (options.shards > std::min(largest, specimens))
    throw InputError(fmt::format(
        "--shards {}: there are {} specimens, and a job array of this cluster has at most {} tasks; give at "
        "most {}",
        options.shards, specimens, largest, std::min(largest, specimens)));
  cluster::Wishes wishes{options.shards,     options.threads,      options.time,     options.memory,
                         options.merge_time, options.merge_memory, options.partition};
  double mean_seconds = 1;  // where no pilot tells
  if (options.shards == 0 || options.time.empty() || options.memory.empty()) {
    const cluster::Pilot pilot = run_pilot(call, options, cohort, missing);
    const std::size_t left = std::max<std::size_t>(1, number_missing(missing));
    if (wishes.shards == 0) wishes.shards = cluster::shards_for(pilot, left, options.threads, largest);
    const std::size_t each = (specimens + wishes.shards - 1) / wishes.shards;
    const cluster::Limits limits = cluster::shard_limits(pilot, each, options.threads);
    if (wishes.time.empty()) wishes.time = std::to_string(limits.minutes);
    if (wishes.memory.empty()) wishes.memory = fmt::format("{}M", limits.mebibytes);
    mean_seconds = pilot.mean_seconds;
    answer("{}Shards:   {} of at most {} specimens, about {:.2g} min each\n", describe_pilot(pilot), wishes.shards,
           each, cluster::shard_seconds(pilot, each, options.threads) / 60);
    answer("Limits:   {} min ({} × the longest specimens, and {} min), {} ({} × the pilot's memory)\n", wishes.time,
           cluster::time_margin, cluster::spare_seconds / 60, wishes.memory, cluster::memory_margin);
  }
  const auto limits = cluster::merge_limits(specimens, scan_seconds, mean_seconds);
  if (wishes.merge_time.empty()) wishes.merge_time = std::to_string(limits.minutes);
  if (wishes.merge_memory.empty()) wishes.merge_memory = fmt::format("{}M", limits.mebibytes);
  return wishes;
}

void write_scripts(const cluster::Invocation& call, const cluster::Submission& submission) {
  const auto folder = cluster::queue_folder(call.results);
  execution::write_atomically(folder / "shard.sh", cluster::shard_script(call, submission.wishes));
  execution::write_atomically(folder / "merge.sh", cluster::merge_script(call, submission.wishes));
}

std::string numbers_of_living(const std::vector<cluster::slurm::Task>& tasks, const std::string& name,
                              const char* separator) {
  std::vector<std::string> numbers;
  for (const auto& task : tasks)
    if (task.alive() && task.name == name) numbers.push_back(task.job);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::string text;
  for (const auto& number : numbers) text += (text.empty() ? "" : separator) + number;
  return text;
}

void refuse_where_alive(const cluster::Submission& submission, const ClusterCohort& cohort) {
  const auto tasks = cluster::slurm::queue({submission.name, submission.merge_name()});
  const auto alive =
      std::count_if(tasks.begin(), tasks.end(), [](const cluster::slurm::Task& task) { return task.alive(); });
  if (alive == 0) return;
  std::string numbers = numbers_of_living(tasks, submission.name, " ");
  const std::string merges = numbers_of_living(tasks, submission.merge_name(), " ");
  if (!numbers.empty() && !merges.empty()) numbers += ' ';
  numbers += merges;
  throw InputError(fmt::format(
      "{}: jobs of this cohort are alive: {} ({} tasks), so nothing was submitted. Look with `{}` how far they "
      "are; `{}` repeats shards that have stopped; `scancel {}` ends them all, and what they fitted stays",
      cohort.results.string(), numbers, alive, cohort.command("status"), cohort.command("resubmit"), numbers));
}

/// Each number is on disk before the next job is submitted.
void submit_and_tell(cluster::Submission& submission, const ClusterCohort& cohort, const std::string& array,
                     const std::string& alive, bool dry_run) {
  std::string after = alive;
  if (dry_run) {
    if (!array.empty()) {
      answer("{}\n", text::quoted(cluster::slurm::words_of(cluster::shards_order(submission, cohort.results, array))));
      after += (after.empty() ? "" : ":") + std::string("JOB");
    }
    answer("{}\n", text::quoted(cluster::slurm::words_of(cluster::merge_order(submission, cohort.results, after))));
    return;
  }
  cluster::store(submission, cohort.results);
  if (!array.empty()) {
    const auto job = cluster::slurm::submit(cluster::shards_order(submission, cohort.results, array));
    submission.jobs.push_back({job, array});
    cluster::store(submission, cohort.results);
    answer("Job {}: shards {}\n", job, array);
    after += (after.empty() ? "" : ":") + job;
  }
  try {
    const auto merge = cluster::slurm::submit(cluster::merge_order(submission, cohort.results, after));
    submission.jobs.push_back({merge, ""});
    cluster::store(submission, cohort.results);
    answer("Job {}: the merge, when they have ended\nStatus:   {}\n", merge, cohort.command("status"));
  } catch (const InputError& refusal) {
    throw InputError(fmt::format("the shards were submitted, but not the merge: {}. Run `{}`, which submits it",
                                 refusal.what(), cohort.command("resubmit")));
  }
}

int nothing_missing(const ClusterCohort& cohort) {
  answer("No specimen is left to fit, so nothing was submitted.\nMerge:    {}\n", cohort.command("merge"));
  return done;
}

}  // namespace

int submit_cohort(const GlobalOptions& global, const ClusterOptions& options) {
  const ClusterCohort cohort(global, options);
  cohort::results_folder(cohort.results, cohort.specification.name);
  execution::write_atomically(cohort.results / "cohort.json", cohort.specification.text);
  const cluster::SubmissionLock lock(cohort.results);
  const auto earlier = cluster::stored_submission(cohort.results);
  cluster::Submission submission;
  submission.name = earlier ? earlier->name
                            : cluster::job_name(cohort.specification.name, std::filesystem::canonical(cohort.results));
  if (earlier) submission.jobs = earlier->jobs;
  if (!options.dry_run) refuse_where_alive(submission, cohort);
  const auto begin = Clock::now();
  auto missing = cohort.missing();
  const double scan_seconds = seconds_since(begin);
  if (number_missing(missing) == 0) return nothing_missing(cohort);
  const auto call = invocation(global, options, cohort);
  submission.wishes = plan(options, cohort, call, missing, scan_seconds);
  if (number_missing(missing) == 0) return nothing_missing(cohort);
  write_scripts(call, submission);
  cluster::ArrayText array;
  for (const auto& one : cohort::progress_of_shares(missing, submission.wishes.shards))
    if (one.missing > 0) array.add(one.share.part);
  submit_and_tell(submission, cohort, array.text(), "", options.dry_run);
  return done;
}

int resubmit_cohort(const GlobalOptions& global, const ClusterOptions& options) {
  const ClusterCohort cohort(global, options);
  auto stored = cluster::stored_submission(cohort.results);
  if (!stored)
    throw InputError(fmt::format("{}: nothing was submitted from this folder; start with `{} --slurm`",
                                 cohort.results.string(), cohort.command("submit")));
  const cluster::SubmissionLock lock(cohort.results);
  cluster::Submission submission = *cluster::stored_submission(cohort.results);
  if (!options.time.empty()) submission.wishes.time = options.time;
  if (!options.memory.empty()) submission.wishes.memory = options.memory;
  if (!options.merge_time.empty()) submission.wishes.merge_time = options.merge_time;
  if (!options.merge_memory.empty()) submission.wishes.merge_memory = options.merge_memory;
  if (!options.partition.empty()) submission.wishes.partition = options.partition;
  const auto tasks = cluster::known_tasks(submission);
  const auto view = cluster::overview(
      submission, cohort::progress_of_shares(cohort.missing(), submission.wishes.shards), tasks, cohort.results);
  const bool merge_waits = view.merge && view.merge->alive();
  if (view.missing == 0 && !merge_waits && !view.stuck()) return nothing_missing(cohort);
  cluster::ArrayText array;
  for (const auto& shard : view.shards)
    if (shard.standing == cluster::Standing::stopped) array.add(shard.progress.share.part);
  if (array.text().empty() && merge_waits) {
    answer("Nothing has stopped: {} shards are running, {} are waiting, and the merge waits for them.\n",
           view.count(cluster::Standing::running), view.count(cluster::Standing::waiting));
    return done;
  }
  // A merge that waits for the old jobs alone would only find specimens missing.
  if (merge_waits && !options.dry_run) cluster::slurm::cancel(view.merge->job);
  submit_and_tell(submission, cohort, array.text(), numbers_of_living(tasks, submission.name, ":"), options.dry_run);
  return done;
}

}  // namespace tunica::app
