// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiment/experiment.hpp"

namespace tunica::diagnosis {

/// What is asked: the "diagnosis" block of the experiment file and the command line.
struct Settings {
  std::string model;                    ///< name of an entry of "models"; empty where every test names its layers
  std::string optimizer;                ///< one more start of the base fit is what it finds; empty = none
  double alpha = 0.05;                  ///< false alarms that are accepted
  std::vector<std::string> mechanisms;  ///< ids to consider; empty = all
  bool admissibility = false;           ///< lost stability changes the verdict
  bool quick = false;                   ///< linear bootstrap only, refits of the likeliest causes only
  std::uint64_t seed = 1;
  /// How far it is, for a person: what is being done, and the share that is done. Called from any thread.
  std::function<void(const std::string& what, double share)> progress = {};
};

/// Fills in what the file leaves open: the model of the first run.
Settings settings_of(const experiment::Experiment& experiment);

}  // namespace tunica::diagnosis
