// SPDX-License-Identifier: Apache-2.0
#include "experiment/materials.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace tunica::experiment {

extern const char* const published_stiffness_json;  // published_stiffness.cpp.in

const std::vector<PublishedStiffness>& published_stiffness() {
  static const std::vector<PublishedStiffness> all = [] {
    std::vector<PublishedStiffness> found;
    const auto figures = nlohmann::json::parse(published_stiffness_json);
    for (const auto& [name, one] : figures.at("materials").items())
      found.push_back(
          {name, one.at("kPa").get<double>(), figures.at("factor").get<double>(), one.at("source").get<std::string>()});
    return found;
  }();
  return all;
}

std::vector<std::string> known_materials() {
  std::vector<std::string> names;
  for (const PublishedStiffness& one : published_stiffness()) names.push_back(one.material);
  return names;
}

std::optional<PublishedStiffness> stiffness_of(const std::string& material) {
  const auto& all = published_stiffness();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.material == material; });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

}  // namespace tunica::experiment
