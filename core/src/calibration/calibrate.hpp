// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "comparison/provenance.hpp"
#include "comparison/summary.hpp"
#include "execution/plan.hpp"
#include "execution/progress.hpp"
#include "execution/share.hpp"

/// Everything that `tunica run` does, as a function.
namespace tunica::calibration {

/// The answer of a fresh process that did not take part in the search, see comparison/certify.hpp.
struct Certified {
  std::string answer;   ///< what comparison::certify() printed there; empty without
  std::string missing;  ///< why there is no answer
};

/// The coming search, and the folder of its results.
struct Start {
  const execution::Plan& plan;
  const std::filesystem::path& directory;
};

struct Options {
  std::optional<std::filesystem::path> directory = {};  ///< new, or to be resumed; without it results/<name>-<n>
  bool resume = false;
  std::optional<execution::Share> share = {};  ///< search this part of the realisations, and no more
  bool merge = false;                          ///< take all realisations from the parts in the directory
  unsigned threads = 1;
  execution::Progress::Style progress = execution::Progress::Style::none;
  std::function<void(double share, const std::string& text)> told = {};  ///< see execution::RunSettings
  std::function<void(const std::string& sentence)> noticed = {};         ///< see execution::RunSettings
  comparison::Told concluding = {};                                      ///< what is done after the searches
  std::vector<std::string> refusals = {};                                ///< of plugins, for the warnings
  /// Asks a fresh process about the best points that stand in the file of the folder.
  std::function<Certified(const std::filesystem::path& directory, const std::filesystem::path& points)> certify = {};
  std::function<void(const Start&)> started = {};  ///< called before the first evaluation
  /// Called by another thread where something does not stop soon after Ctrl-C; ends the process.
  std::function<void(const std::filesystem::path& directory)> abandon = {};
};

struct Outcome {
  enum class Ending { finished, part_finished, interrupted, write_failure };
  Ending ending = Ending::finished;
  std::string write_failure = {};  ///< which file, why, and what to do
  std::filesystem::path directory = {};
  // Of what has finished:
  comparison::Summary summary = {};
  comparison::Provenance provenance = {};
  std::filesystem::path result = {}, report = {};

  /// Every run came to a fit, see comparison/conclusion.hpp, and neither its optimiser nor the failure policy gave up.
  [[nodiscard]] bool sound() const;
};

/// Plans, searches, compares, certifies, analyses; writes result.json, the tables and report.html. An interrupted run
/// is saved and can be resumed to the identical result, and so is one that could not write. A resumed run that ended
/// before its first checkpoint begins again. Throws InputError where experiment, data or folder do not fit.
Outcome calibrate(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                  const Options& options);

}  // namespace tunica::calibration
