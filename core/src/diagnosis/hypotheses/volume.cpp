// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/hypotheses/volume.hpp"

#include <algorithm>

namespace tunica::diagnosis {

bool changes_volume(const assembly::Assembly& assembly) {
  for (std::size_t m = 0; m < assembly.models().count(); ++m)
    if (assembly.models().model(m).describe().compressible) return true;
  return false;
}

bool sees_volume(const assembly::Assembly& base, const experiment::Experiment& experiment,
                 const plugins::Catalogue& catalogue) {
  const auto& channels = base.layout().channels;
  return std::any_of(channels.begin(), channels.end(), [&](const assembly::MeasuredChannel& channel) {
    if (channel.changes_volume || channel.is_field()) return true;
    const auto& test = catalogue.tests().at(experiment.test(channel.test).type).factory;
    return std::any_of(test.observables.begin(), test.observables.end(), [&](const Observable& one) {
      return one.name == channel.observable && (one.kind == Observable::Kind::stretch || one.name == "volume_ratio");
    });
  });
}

}  // namespace tunica::diagnosis
