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
  unsigned threads = 1;             ///< shared by realisations and population members
  bool resume = false;
  Share share = {};  ///< of the realisations; the others stay unfinished, without counting as interrupted
  Progress::Style progress = Progress::Style::none;
  /// A separate thread calls it ten times a second with the spent share of the budget and the line of Progress.
  std::function<void(double share, const std::string& text)> told = {};
  /// Called before the first evaluation of a resumed run, with the damage to its files and the consequence.
  std::function<void(const std::string& sentence)> noticed = {};
};

struct Execution {
  std::vector<RunResult> runs;  ///< one a planned run
  bool interrupted = false;     ///< saved; to be resumed
  std::string write_failure;    ///< why nothing more could be written; empty = all is on disk
  double seconds = 0;           ///< wall-clock time of this process
};

/// Runs every realisation of the plan and maintains evaluations.csv, checkpoint.json, input.json and run.log. The
/// outcome does not depend on the number of threads: every realisation has its own seed, and the problem orders the
/// parallel work within it. Realisations start in order. A thread without a realisation helps with the population
/// members of others. A thread that waits for its own members never starts another realisation meanwhile, because some
/// libraries have thread-local generators. Ctrl-C is obeyed while an InterruptWatch lives. Throws InputError when a
/// resume is refused; see Checkpoint.
Execution execute(const Plan& plan, const RunSettings& settings);

}  // namespace tunica::execution
