// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cluster/slurm.hpp"
#include "execution/files.hpp"

namespace tunica::cluster {

/// The request of a cohort to the queue.
struct Wishes {
  std::size_t shards = 1;
  unsigned threads = 1;
  std::string time, memory;              ///< of a shard, as sbatch takes them
  std::string merge_time, merge_memory;  ///< of the merge
  std::string partition;                 ///< empty = the cluster's own choice
};

/// A job that was submitted.
struct Job {
  std::string id;
  std::string array;  ///< shards in it, "1-3,7"; empty for the merge
};

/// What became of a cohort on the queue: DIR/slurm/jobs.json. It is written before the first job is submitted and after
/// each. A job whose number could not be written any more is found by its name.
struct Submission {
  std::string name;  ///< of the array; the merge is called <name>-merge
  Wishes wishes;
  std::vector<Job> jobs;  ///< oldest first

  [[nodiscard]] std::string merge_name() const { return name + "-merge"; }
};

std::filesystem::path queue_folder(const std::filesystem::path& results);
std::filesystem::path shard_log(const std::filesystem::path& results, std::size_t part);

/// A name that no other folder's jobs have: tunica-<cohort>-<8 digits of the folder's hash>.
std::string job_name(const std::string& cohort, const std::filesystem::path& results);

/// None without a submission. Throws InputError if the file is not a submission file.
std::optional<Submission> stored_submission(const std::filesystem::path& results);
void store(const Submission& submission, const std::filesystem::path& results);

/// Held while somebody submits, so that two of them cannot do it at once. Throws InputError where another holds it. It
/// goes with the process.
class SubmissionLock {
 public:
  explicit SubmissionLock(const std::filesystem::path& results);

 private:
  execution::AppendFile file_;
};

/// How the program is called again on a node: absolute paths, no shell's cares.
struct Invocation {
  std::filesystem::path program;
  std::vector<std::string> options;  ///< in front of the verb: plugin paths
  std::string plugin_path;           ///< TUNICA_PLUGIN_PATH, absolute; empty = not set
  std::filesystem::path cohort, results;
  std::vector<std::string> shard_options;  ///< of a shard only: --no-reports
};

/// The scripts of a shard and of the merge; the shard's takes its part from the job array.
std::string shard_script(const Invocation& call, const Wishes& wishes);
std::string merge_script(const Invocation& call, const Wishes& wishes);

/// The orders of both jobs, whose scripts are DIR/slurm/shard.sh and merge.sh.
slurm::Order shards_order(const Submission& submission, const std::filesystem::path& results, const std::string& array);
slurm::Order merge_order(const Submission& submission, const std::filesystem::path& results, const std::string& after);

}  // namespace tunica::cluster
