// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/request.hpp"

#include <nlohmann/json.hpp>

namespace tunica::diagnosis {

Request request_of(const experiment::Experiment& experiment) {
  Request request;
  request.seed = experiment.seed;
  if (!experiment.runs.empty()) request.model = experiment.runs.front().model;
  if (experiment.diagnosis_json.empty()) return request;
  const auto json = nlohmann::json::parse(experiment.diagnosis_json);
  request.model = json.value("model", request.model);
  request.optimizer = json.value("optimizer", std::string());
  request.alpha = json.value("alpha", request.alpha);
  request.admissibility = json.value("admissibility", false);
  if (const auto names = json.find("mechanisms"); names != json.end() && names->is_array())
    request.mechanisms = names->get<std::vector<std::string>>();
  return request;
}

}  // namespace tunica::diagnosis
