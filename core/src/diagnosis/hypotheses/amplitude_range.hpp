// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/hypotheses/extension.hpp"

namespace tunica::diagnosis {

/// The amplitude range of an addition: from the data, or else as the mechanism declares it.
AmplitudeRange range_of(const MechanismFactory& mechanism, const Addition& addition);

/// The range of an amplitude whose size depends on the specimen; none if the mechanism's own range holds for all data.
/// If the mechanism acts on a channel and is not an error of the record, plausible amplitudes span the channel. For
/// MechanismFactory::plausible_effect = q,
///
///   |a − null| ≤ q min_c (max y_c − min y_c)/max_i |∂f_ci/∂a|
///
/// over the channels c that it acts on, at the null and the base fit, for the setting that allows most; bounds lie five
/// times as far out.
/// `extended` has the one addition and its parameters at `null`; `settings` are those of its nuisance parameters.
std::optional<AmplitudeRange> range_from_data(const Extension& extended, const MechanismFactory& mechanism,
                                              const std::vector<MechanismFactory::Setting>& settings,
                                              const std::vector<double>& null, assembly::Workspace& workspace);

/// `null` with the nuisance parameters of the only addition where a setting has them.
std::vector<double> with_setting(const Extension& extended, const MechanismFactory& mechanism,
                                 const MechanismFactory::Setting& setting, std::vector<double> null);

}  // namespace tunica::diagnosis
