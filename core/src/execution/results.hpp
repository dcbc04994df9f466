// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "search/calibration_problem.hpp"

namespace tunica::execution {

/// A feasible evaluation that was better than all earlier ones.
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
  std::string reason;      ///< the optimiser's reason for returning
  search::StopReason stopped_by =
      search::StopReason::none;  ///< for optimizer_failure, `reason` is the exception's text
  std::string stop_sentence;     ///< the same in words; empty for none
  bool memory_lacked = false;    ///< memory ran out and ended the search; no evidence about its aim
  double seconds = 0;
};

/// The results that the execution passes to the comparison, one entry per run in the order of the file.
struct RunResult {
  std::vector<RealisationResult> realisations;
};

}  // namespace tunica::execution
