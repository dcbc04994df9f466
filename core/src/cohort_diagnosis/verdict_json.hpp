// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cohort_diagnosis/cohort_verdict.hpp"

namespace tunica::cohort_diagnosis {

/// `diagnosis` of a cohort's result.json.
nlohmann::ordered_json to_json(const CohortVerdict& verdict);

}  // namespace tunica::cohort_diagnosis
