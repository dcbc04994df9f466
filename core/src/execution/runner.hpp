// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "execution/plan.hpp"
#include "execution/progress.hpp"
#include "execution/results.hpp"
#include "execution/share.hpp"

namespace tunica::execution {

struct RunSettings {
  std::filesystem::path directory;  ///< of a RunDirectory
  unsigned threads = 1;             ///< the one budget for realisations and population members together
  bool resume = false;
  Share share = {};  ///< of the realisations; the others stay unfinished, which is then no interruption
  Progress::Style progress = Progress::Style::none;
  /// Told ten times a second by a thread of its own: the share of the budget that is spent, and the line of Progress.
  std::function<void(double share, const std::string& text)> told = {};
  /// Told before the first evaluation of a resumed run what of its files was damaged, and what becomes of it.
  std::function<void(const std::string& sentence)> noticed = {};
};

struct Execution {
  std::vector<RunResult> runs;  ///< one a planned run
  bool interrupted = false;     ///< saved; to be resumed
  std::string write_failure;    ///< why nothing more could be written; empty = all is on disk
  double seconds = 0;           ///< wall-clock time of this process
};

/// Runs every realisation of the plan and keeps evaluations.csv, checkpoint.json, input.json and run.log while doing
/// so. The outcome does not depend on the number of threads: every realisation has a seed of its own, and what runs
/// side by side inside one is put in order by the problem. Realisations are started in order; a thread that has none
/// left helps with the population members of the others, but one that waits for its own members never starts a
/// stranger's realisation meanwhile (generators of some libraries are thread-local).
/// Ctrl-C is obeyed while an InterruptWatch lives. Throws InputError when a resume is refused; see Checkpoint.
Execution execute(const Plan& plan, const RunSettings& settings);

}  // namespace tunica::execution
