// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

/// Published stiffnesses of materials: the figures are data in published_stiffness.json.
namespace tunica::experiment {

/// Key of a model: what its material is.
inline constexpr const char* material_key = "material";

struct PublishedStiffness {
  std::string material;
  double stiffness = 0;  ///< kPa, largest stress over largest stretch less 1
  double factor = 1;     ///< either way of it, within which no question is asked
  std::string source;
};

/// All that are known, by name.
const std::vector<PublishedStiffness>& published_stiffness();
std::vector<std::string> known_materials();
std::optional<PublishedStiffness> stiffness_of(const std::string& material);

}  // namespace tunica::experiment
