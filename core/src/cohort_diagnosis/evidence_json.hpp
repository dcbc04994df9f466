// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cohort_diagnosis/specimen_evidence.hpp"

namespace tunica::cohort_diagnosis {

/// The record of a shard: read back, it is the same bit for bit.
nlohmann::ordered_json to_json(const SpecimenEvidence& specimen);

/// Throws InputError if the text is not such a record; `where` names its file.
SpecimenEvidence evidence_from_json(const nlohmann::ordered_json& json, const std::string& where);

}  // namespace tunica::cohort_diagnosis
