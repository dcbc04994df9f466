// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/settings.hpp"

namespace tunica::diagnosis {

Settings settings_of(const experiment::Experiment& experiment) {
  Settings settings;
  settings.seed = experiment.seed;
  if (!experiment.runs.empty()) settings.model = experiment.runs.front().model;
  if (!experiment.diagnosis) return settings;
  const experiment::DiagnosisEntry& entry = *experiment.diagnosis;
  settings.model = entry.model.value_or(settings.model);
  settings.optimizer = entry.optimizer.value_or("");
  settings.alpha = entry.alpha.value_or(settings.alpha);
  settings.admissibility = entry.admissibility.value_or(false);
  settings.mechanisms = entry.mechanisms;
  return settings;
}

}  // namespace tunica::diagnosis
