// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/settings.hpp"

#include <nlohmann/json.hpp>

namespace tunica::diagnosis {

Settings settings_of(const experiment::Experiment& experiment) {
  Settings settings;
  settings.seed = experiment.seed;
  if (!experiment.runs.empty()) settings.model = experiment.runs.front().model;
  if (experiment.diagnosis_json.empty()) return settings;
  const auto json = nlohmann::json::parse(experiment.diagnosis_json);
  settings.model = json.value("model", settings.model);
  settings.optimizer = json.value("optimizer", std::string());
  settings.alpha = json.value("alpha", settings.alpha);
  settings.admissibility = json.value("admissibility", false);
  if (const auto names = json.find("mechanisms"); names != json.end() && names->is_array())
    settings.mechanisms = names->get<std::vector<std::string>>();
  return settings;
}

}  // namespace tunica::diagnosis
