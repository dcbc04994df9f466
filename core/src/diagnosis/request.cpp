// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/request.hpp"

namespace tunica::diagnosis {

Request request_of(const experiment::Experiment& experiment) {
  Request request;
  request.seed = experiment.seed;
  if (!experiment.runs.empty()) request.model = experiment.runs.front().model;
  if (!experiment.diagnosis) return request;
  const experiment::DiagnosisEntry& entry = *experiment.diagnosis;
  request.model = entry.model.value_or(request.model);
  request.optimizer = entry.optimizer.value_or("");
  request.alpha = entry.alpha.value_or(request.alpha);
  request.admissibility = entry.admissibility.value_or(false);
  request.mechanisms = entry.mechanisms;
  if (!entry.groups.empty()) request.groups = entry.groups;
  request.wrong_files = entry.wrong_files.value_or(request.wrong_files);
  request.tolerance = entry.tolerance;
  return request;
}

const experiment::RunEntry* run_of_model(const experiment::Experiment& experiment, const std::string& model) {
  for (const experiment::RunEntry& run : experiment.runs)
    if (run.model == model) return &run;
  return nullptr;
}

}  // namespace tunica::diagnosis
