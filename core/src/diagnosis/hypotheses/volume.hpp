// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "assembly/assembly.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::diagnosis {

/// Whether a material of the assembly can change its volume.
bool changes_volume(const assembly::Assembly& assembly);

/// Whether a lateral stretch, a volume, or a load that changes the volume was measured. In the stress alone, a change
/// of volume looks like many errors of a rig.
bool sees_volume(const assembly::Assembly& base, const experiment::Experiment& experiment,
                 const plugins::Catalogue& catalogue);

}  // namespace tunica::diagnosis
