// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/next_experiment.hpp"

#include <fmt/format.h>

namespace tunica::diagnosis {

std::optional<NextExperiment> next_experiment(const Diagnosis& d, const plugins::Catalogue& catalogue) {
  if (d.ambiguity_set.empty()) return std::nullopt;
  const MechanismFactory& first = catalogue.mechanisms().at(d.ambiguity_set.front()).factory;
  return NextExperiment{first.isolated_by, d.ambiguity_set, std::nullopt};
}

}  // namespace tunica::diagnosis
