// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "comparison/simulation.hpp"
#include "comparison/summary.hpp"

/// What `tunica stability` does, as functions.
namespace tunica::comparison {

struct StabilityRequest {
  std::optional<double> to = {};                        ///< stretch to judge up to; none: the largest measured one
  std::optional<std::array<std::string, 2>> map = {};   ///< of these two free parameters
  std::size_t points = 41;                              ///< of the map along each parameter
  std::optional<std::filesystem::path> directory = {};  ///< a new folder for the tables; none: nothing is written
};

struct StabilityAnswer {
  StabilitySummary found;
  std::vector<std::string> files;  ///< that were written

  /// Whether the response could be followed anywhere: without, nothing was judged.
  [[nodiscard]] bool any_assessed() const;
};

/// Judges a subject of the experiment `name`, and writes its tables where a folder is asked for. Throws InputError
/// where the folder is there already, a map has no folder, or a name of the map is no free parameter.
StabilityAnswer judge_stability(const std::string& name, const Subject& subject, const StabilityRequest& request);

/// As `best.stability` of result.json, with the parameters that were judged.
nlohmann::ordered_json stability_answer_json(const Subject& subject, const StabilityAnswer& answer);

}  // namespace tunica::comparison
