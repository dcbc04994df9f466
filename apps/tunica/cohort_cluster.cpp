// SPDX-License-Identifier: Apache-2.0
#include "cohort_cluster.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "answer.hpp"
#include "cluster/command.hpp"
#include "cluster/overview.hpp"
#include "cohort/presence.hpp"
#include "exit_codes.hpp"
#include "text/shell.hpp"
#include "tunica/error.hpp"

namespace tunica::app {

namespace {

std::filesystem::path absolute_folder(const std::string& directory) {
  const auto path = std::filesystem::absolute(directory).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

CLI::App* add_verb(CLI::App& cohort, const char* name, const char* doc, ClusterOptions& options) {
  auto* verb = cohort.add_subcommand(name, doc);
  verb->add_option("cohort", options.file, "Cohort file (JSON)")->required()->type_name("FILE");
  verb->add_option("-o,--output", options.directory, "Folder of the results, which every node of the cluster can reach")
      ->required()
      ->type_name("DIR");
  return verb;
}

void add_limits(CLI::App& verb, ClusterOptions& options, const std::string& without) {
  verb.add_option("--partition", options.partition, "Partition of the cluster; " + without)->type_name("P");
  verb.add_option("--time", options.time, "Time limit of a shard, as sbatch takes it: 30, 2:00:00; " + without)
      ->type_name("T");
  verb.add_option("--memory", options.memory, "Memory of a shard, as sbatch takes it: 500M, 2G; " + without)
      ->type_name("M");
  verb.add_option("--merge-time", options.merge_time, "Time limit of the merge")->type_name("T");
  verb.add_option("--merge-memory", options.merge_memory, "Memory of the merge")->type_name("M");
  verb.add_flag("--dry-run", options.dry_run, "Write the scripts and print what would be submitted");
}

/// What to do about a shard that a limit ended.
bool ended_by_a_limit(const cluster::ShardView& shard) {
  return shard.standing == cluster::Standing::stopped && (shard.state == "TIMEOUT" || shard.state == "OUT_OF_MEMORY");
}

}  // namespace

ClusterCohort::ClusterCohort(const GlobalOptions& global, const ClusterOptions& options)
    : session(global),
      specification(cohort::read_specification(options.file)),
      table(cohort::read_specimens(specification)),
      pattern(specification, table),
      file(std::filesystem::absolute(options.file).lexically_normal()),
      results(absolute_folder(options.directory)),
      plugins(plugin_words(global)) {}

std::vector<char> ClusterCohort::missing() const {
  return cohort::missing_records(specification, table, pattern, session.catalogue(), results);
}

std::string ClusterCohort::command(const std::string& verb) const {
  std::vector<std::string> words{"tunica", "cohort", verb, file.string(), "-o", results.string()};
  words.insert(words.end(), plugins.begin(), plugins.end());
  return text::quoted(words);
}

int tell_status(const GlobalOptions& global, const ClusterOptions& options) {
  const ClusterCohort cohort(global, options);
  const auto stored = cluster::stored_submission(cohort.results);
  const cluster::Submission submission = stored.value_or(cluster::Submission{});
  std::vector<cluster::slurm::Task> tasks;
  std::string problem;
  if (stored) try {
      tasks = cluster::known_tasks(submission);
    } catch (const InputError& refusal) {
      problem = refusal.what();
    }
  // The queue is asked before the records: a shard that ends between the two is done, not stopped.
  const auto progress = cohort::progress_of_shares(cohort.missing(), submission.wishes.shards);
  auto view = cluster::overview(submission, progress, tasks, cohort.results);
  view.queue_problem = problem;
  const int code = view.stuck() && problem.empty() ? not_converged : done;
  if (options.json) {
    answer("{}", cluster::in_json(view, submission));
    return code;
  }
  answer("{}", cluster::in_words(view, submission));
  if (view.missing == 0 && view.merge && view.merge->phase == cluster::slurm::Phase::ended)
    answer("Results:  {}\n", cohort.results.string());
  else if (view.missing == 0 && !view.merge)
    answer("Merge:    {}\n", cohort.command("merge"));
  if (code == done) return code;
  if (!stored) {
    answer("Go on:    {} --slurm\n", cohort.command("submit"));
    return code;
  }
  if (std::any_of(view.shards.begin(), view.shards.end(), ended_by_a_limit))
    answer("A limit ended some; give them more with --time or --memory.\n");
  answer("Go on:    {}\n", cohort.command("resubmit"));
  return code;
}

void add_cohort_cluster(CLI::App& cohort, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<ClusterOptions>();
  auto* submit = add_verb(cohort, "submit", "Give the shards of the cohort to the queue of a cluster", *options);
  submit->add_flag("--slurm", options->slurm, "The queue: Slurm, a job array and a merge that waits for it")
      ->required();
  submit->add_option("--shards", options->shards, "Number of shards; without it each takes about 20 minutes")
      ->check(CLI::Range(1, 100000))
      ->type_name("N");
  submit
      ->add_option("--pilot", options->pilot, "Specimens that are fitted here to measure time and memory; 3 without it")
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
  submit->add_option("-j,--threads", options->threads, "Threads of a shard; 1 without it")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  add_limits(*submit, *options, "from the pilot without it");
  submit->get_option("--partition")->description("Partition of the cluster; its own choice without it");
  auto* reports = submit->add_flag("--reports", options->reports, "A report.html for each specimen, however many");
  submit->add_flag("--no-reports", options->no_reports, "No report.html for single specimens")->excludes(reports);
  submit->footer(
      "Example:\n"
      "  tunica cohort submit cohort.json -o /shared/aortas --slurm\n\n"
      "Fits a few specimens here first, unless --shards, --time and --memory are all given. How a shard is run by hand "
      "or\nby another queue: docs/cohort_cluster.md.");
  submit->callback(
      [&global, &action, options] { action = [&global, options] { return submit_cohort(global, *options); }; });

  auto* status =
      add_verb(cohort, "status", "Say how far the shards of a cohort are, and why some have stopped", *options);
  status->add_flag("--json", options->json, "One JSON document instead of text");
  status->footer(
      "Example:\n"
      "  tunica cohort status cohort.json -o /shared/aortas\n\n"
      "Exit code 1: something has stopped, and `resubmit` goes on with it.");
  status->callback(
      [&global, &action, options] { action = [&global, options] { return tell_status(global, *options); }; });

  auto* resubmit = add_verb(cohort, "resubmit", "Submit again the shards that have stopped, and a new merge", *options);
  add_limits(*resubmit, *options, "as before without it");
  resubmit->footer(
      "Example:\n"
      "  tunica cohort resubmit cohort.json -o /shared/aortas --time 2:00:00\n\n"
      "Shards that run or wait are left alone.");
  resubmit->callback(
      [&global, &action, options] { action = [&global, options] { return resubmit_cohort(global, *options); }; });
}

}  // namespace tunica::app
