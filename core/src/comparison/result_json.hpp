// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "comparison/provenance.hpp"
#include "comparison/summary.hpp"

namespace tunica::comparison {

/// result.json, as schemas/tunica-result.schema.json says: warnings first, base units, `ci95` null where the data do
/// not fix a parameter. Only seconds and date differ between two runs with the same input and seed.
std::string result_json(const Summary& summary, const Provenance& provenance);

/// One entry of `warning_details`.
nlohmann::ordered_json warning_json(const execution::Warning& warning);

/// `misfit` of a run's best point, and of the base of a diagnosis.
nlohmann::ordered_json misfit_json(const assembly::Misfit& misfit);

/// How far each channel is missed, in its unit: of a run's best point, and of a diagnosis.
nlohmann::ordered_json channel_sizes_json(const std::vector<assembly::ChannelSize>& sizes);

}  // namespace tunica::comparison
