// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "calibration/examination.hpp"

namespace tunica::app {

/// What `tunica check --json` prints.
nlohmann::ordered_json check_json(const calibration::Examination& checked);

}  // namespace tunica::app
