// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "execution/plan.hpp"

namespace tunica::app {

/// What one evaluation at the initial point tells of a problem.
struct InitialPoint {
  Status status;
  double objective = 0;
  std::vector<double> per_test;
  double seconds = 0;  ///< of one evaluation, the median over a fifth of a second
  /// What a test finds of itself by other means.
  struct OtherMeans {
    std::string test;
    std::vector<Agreement> found;
    Status status;
  };
  std::vector<OtherMeans> other_means;
  bool analysed = false;               ///< false: the linearisation could not be made
  std::vector<std::string> sentences;  ///< what the data do not fix

  [[nodiscard]] bool good() const;
};

InitialPoint try_initial_point(const execution::PlannedRun& run);

/// Runs that differ only in the optimiser pose the same problem.
struct CheckedProblem {
  std::string title;
  const execution::PlannedRun* run;
  InitialPoint initial;
};

/// Everything that `tunica check` prints.
struct Checked {
  const experiment::Experiment& experiment;
  const execution::Plan& plan;
  std::vector<execution::Warning> warnings;
  std::vector<CheckedProblem> problems;

  [[nodiscard]] bool good() const;
};

nlohmann::ordered_json check_json(const Checked& checked);

}  // namespace tunica::app
