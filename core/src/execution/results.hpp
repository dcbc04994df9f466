// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "search/calibration_problem.hpp"

namespace tunica::execution {

/// A feasible evaluation that was better than every one before it.
struct Improvement {
  std::uint64_t evaluations;  ///< made in the realisation by then, this one included
  double objective;
};

/// How one realisation of one run ended.
struct RealisationResult {
  std::uint64_t realisation = 1;
  bool finished = false;           ///< false: interrupted
  search::Best best;               ///< parameters are empty when no evaluation succeeded
  std::vector<Improvement> trace;  ///< every improvement, in order; the convergence of this realisation
  search::Tally tally;
  bool converged = false;  ///< the optimiser's own word
  std::string reason;      ///< the optimiser's reason for coming back
  search::StopReason stopped_by =
      search::StopReason::none;  ///< of optimizer_failure `reason` says what the optimiser threw
  std::string stop_sentence;     ///< the same in words; empty for none
  bool memory_lacked = false;    ///< which ended the search, and says nothing of what it looked for
  double seconds = 0;
};

/// What the execution hands to the comparison, one entry a run in the order of the file.
struct RunResult {
  std::vector<RealisationResult> realisations;
};

}  // namespace tunica::execution
