// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cluster/slurm.hpp"
#include "cluster/submission.hpp"
#include "cohort/presence.hpp"

namespace tunica::cluster {

enum class Standing {
  done,     ///< every specimen has a record
  running,  ///< a job of the queue is at it
  waiting,  ///< a job of the queue will be
  stopped   ///< specimens are missing, and no job is alive: resubmit
};
inline constexpr text::Codes<Standing, 4> standing_codes{{{Standing::done, "done"},
                                                          {Standing::running, "running"},
                                                          {Standing::waiting, "waiting"},
                                                          {Standing::stopped, "stopped"}}};

/// One shard: the state of its specimens and its state in the queue.
struct ShardView {
  cohort::ShareProgress progress;
  Standing standing = Standing::stopped;
  std::string job;            ///< the newest that was to make it; empty = none is known
  std::string state, reason;  ///< in Slurm's words; empty where Slurm has forgotten the job, or was not asked
  std::string nodes;
  std::string last_words;  ///< of its log, where it stopped
};

struct Overview {
  std::vector<ShardView> shards;
  std::optional<slurm::Task> merge;  ///< the newest
  std::string merge_last_words;      ///< of its log, where it failed
  std::vector<slurm::Task> held;     ///< jobs that only a user can release
  std::string queue_problem;         ///< why the queue was not asked; empty = it was
  std::size_t specimens = 0, missing = 0;

  [[nodiscard]] std::size_t count(Standing standing) const;
  /// Somebody has to resubmit: specimens are missing and no job is alive that could make them, or
  /// all are there and the merge failed.
  [[nodiscard]] bool stuck() const;
};

/// What Slurm knows of the jobs of this submission: the queue's tasks, and those of the accounts that the queue has
/// forgotten. Throws InputError where squeue does not answer.
std::vector<slurm::Task> known_tasks(const Submission& submission);

Overview overview(const Submission& submission, const std::vector<cohort::ShareProgress>& progress,
                  const std::vector<slurm::Task>& tasks, const std::filesystem::path& results);

/// For people, and as one JSON document for scripts.
std::string in_words(const Overview& view, const Submission& submission);
std::string in_json(const Overview& view, const Submission& submission);

}  // namespace tunica::cluster
