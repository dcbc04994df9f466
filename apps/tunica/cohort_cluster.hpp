// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cohort/template.hpp"
#include "session.hpp"
#include "verbs.hpp"

namespace tunica::app {

/// The options of `cohort submit`, `status` and `resubmit`.
struct ClusterOptions {
  std::string file, directory, time, memory, merge_time, merge_memory, partition;
  std::size_t shards = 0;  ///< 0: from the pilot
  std::size_t pilot = 3;
  unsigned threads = 1;
  bool slurm = false, dry_run = false, json = false, reports = false, no_reports = false;
};

/// A cohort that is on a queue, or shall be: what was read, and the folder of its results as every node finds it.
struct ClusterCohort {
  Session session;
  cohort::Specification specification;
  cohort::SpecimenTable table;
  cohort::Template pattern;
  std::filesystem::path file, results;
  std::vector<std::string> plugins;  ///< plugin_words()

  ClusterCohort(const GlobalOptions& global, const ClusterOptions& options);

  /// One byte a specimen: whether it still has to be fitted.
  [[nodiscard]] std::vector<char> missing() const;
  /// "tunica cohort merge FILE -o DIR" for a verb, to be typed.
  [[nodiscard]] std::string command(const std::string& verb) const;
};

int submit_cohort(const GlobalOptions& global, const ClusterOptions& options);
int resubmit_cohort(const GlobalOptions& global, const ClusterOptions& options);
int tell_status(const GlobalOptions& global, const ClusterOptions& options);

/// The verbs below `cohort` that know a queue.
void add_cohort_cluster(CLI::App& cohort, GlobalOptions& global, Action& action);

}  // namespace tunica::app
