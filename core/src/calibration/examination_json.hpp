// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "calibration/examination.hpp"

namespace tunica::calibration {

/// What `tunica check --json` prints.
nlohmann::ordered_json examination_json(const Examination& checked);

}  // namespace tunica::calibration
