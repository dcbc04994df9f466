// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "data/loading_path.hpp"
#include "execution/plan.hpp"
#include "execution/warning.hpp"

/// Everything that `tunica check` does, as a function.
namespace tunica::calibration {

/// A test's comparison with an independent solution.
struct OtherMeans {
  std::string test;
  std::vector<Agreement> found = {};
  Status status = {};
};

/// Whether a test and the independent solution agree within the expected difference.
bool agrees(const Agreement& one);

/// What one evaluation at the initial point tells of a problem.
struct InitialPoint {
  Status status;
  double objective = 0;
  std::vector<double> per_test;
  double seconds = 0;  ///< of one evaluation: the median over a fifth of a second, the first where a test is costly
  std::vector<OtherMeans> other_means;
  bool analysed = false;               ///< false: the linearisation could not be made
  std::vector<std::string> sentences;  ///< what the data do not fix
  /// "test 'strip' runs ccx strip": why nothing was evaluated; empty = it was.
  std::string not_run;

  [[nodiscard]] bool good() const;
};

/// The loading path of a test, for the user to confirm.
struct TestPath {
  std::string test;
  bool ordered = false;  ///< said so, or by time; false: the order of the file is shown
  data::Past past = data::Past::known;
  std::string words;    ///< "stretch 1 → 1.5 → 1.02, 1 cycle, 204 rows; starts at rest"
  std::string drawing;  ///< the first abscissa over the rows, one line of blocks
};

/// Runs that differ only in the optimiser pose the same problem.
struct PosedProblem {
  std::string title;
  const execution::PlannedRun* run;
  InitialPoint initial;
};

/// The interpretation of a testing machine's file, one line per column.
struct UnderstoodData {
  std::string test;
  std::vector<std::string> lines;
};

/// Refers to the experiment and the catalogue, which must outlive it.
struct Examination {
  const experiment::Experiment& experiment;
  execution::Plan plan;
  std::vector<execution::Warning> warnings;
  std::vector<std::string> notes;  ///< remarks that are not warnings
  std::vector<PosedProblem> problems;
  std::vector<TestPath> paths;  ///< of tests with several branches, or with a stated order
  std::vector<UnderstoodData> understood = {};

  [[nodiscard]] bool good() const;
};

/// A dry run: plans, and evaluates every problem once at its initial point. Where a test of the problem starts a
/// program that the file names, with its option "command", or asks a server, that is left out unless `run_programs`:
/// the file may be somebody else's. `told`, if any, hears what is about to take long. Throws InputError where
/// experiment, data or analysis do not fit.
Examination examine(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                    bool run_programs = false, const std::function<void(const std::string&)>& told = {});

/// The experiment with the option "offline" set in every test that has it: making such a test contacts no server.
experiment::Experiment offline(experiment::Experiment experiment);

/// "tunica check FILE", and the option that it needs to evaluate a test that starts a program or asks a server.
std::string check_command(const experiment::Experiment& experiment, const std::string& file);

}  // namespace tunica::calibration
