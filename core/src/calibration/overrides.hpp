// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/experiment.hpp"

namespace tunica::calibration {

/// The overrides of a command line over the file.
struct Overrides {
  std::optional<std::uint64_t> seed = {};
  std::vector<std::string> profiles = {};  ///< names of parameters, or "all"; empty = as the file says
  std::optional<std::uint64_t> bootstrap_draws = {};
  std::optional<std::uint64_t> posterior_draws = {};
  std::string keep_evaluations = {};  ///< "all" or "improvements"; empty = as the file says
  bool paired_starts = false;         ///< as the key of that name; false = as the file says
  bool discrepancy = false;  ///< of the posterior, which is drawn if nothing else asks for it; false = as the file says
};

/// Changes the experiment, and the input.json that documents it.
void apply(const Overrides& overrides, const plugins::Catalogue& catalogue, experiment::Experiment& experiment);

}  // namespace tunica::calibration
