// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::diagnosis {

/// The request: the "diagnosis" block of the experiment file and the command line.
struct Request {
  std::string model;                    ///< name of an entry of "models"; empty where every test names its layers
  std::string optimizer;                ///< one more start of the base fit is what it finds; empty = none
  double alpha = 0.05;                  ///< false alarms that are accepted
  std::vector<std::string> mechanisms;  ///< ids to consider; empty = all
  bool admissibility = false;           ///< lost stability changes the verdict
  /// The tolerated misfit: observable (empty = all) and "2 %" of its range, or a quantity in its unit.
  std::vector<std::pair<std::string, std::string>> tolerance = {};
  /// The base is the scaffold of a discovery from nothing. It is no answer, so that its fit may end short of an
  /// optimum.
  bool from_scaffold = false;
  bool quick = false;  ///< linear bootstrap only, refits of the likeliest causes only
  std::uint64_t seed = 1;
  std::vector<std::string> groups = {"material", "rig", "file"};  ///< where causes may lie
  double wrong_files = 0.1;                                       ///< expected share of files with a mistake
  bool discovers = false;  ///< a search for terms of the energy follows where the cause is unknown

  [[nodiscard]] bool considers(const std::string& group) const {
    return std::find(groups.begin(), groups.end(), group) != groups.end();
  }
};

/// Fills in what the file leaves open: the model of the first run.
Request request_of(const experiment::Experiment& experiment);

/// The run that a diagnosis of this model takes for its base: the first one with it; null where none has it.
const experiment::RunEntry* run_of_model(const experiment::Experiment& experiment, const std::string& model);

/// Progress of a diagnosis for people: the stage and the finished share. Called from any thread.
using Progress = std::function<void(const std::string& stage, double share)>;

/// The inputs of every stage besides earlier stages. It holds references to longer-lived objects.
struct Inquiry {
  const experiment::Experiment& experiment;
  const Request& request;
  const plugins::Catalogue& catalogue;
  const Progress& progress;

  void report(const std::string& stage, double share) const {
    if (progress) progress(stage, share);
  }
  /// Called by any thread each time that one of `count` pieces of a stage is done; the stage takes the share of the
  /// whole between `from` and `to`.
  [[nodiscard]] auto steps(const std::string& stage, double from, double to, std::size_t count) const {
    report(stage, from);
    return [this, stage, from, to, count, done = std::make_shared<std::atomic<std::size_t>>(0)] {
      report(stage,
             from + (to - from) * static_cast<double>(++*done) / static_cast<double>(std::max<std::size_t>(count, 1)));
    };
  }
  [[nodiscard]] const MechanismFactory& mechanism(const std::string& id) const {
    return catalogue.mechanisms().at(id).factory;
  }
};

}  // namespace tunica::diagnosis
