// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/detection/alarm.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/hypotheses/hypotheses.hpp"

namespace tunica::diagnosis {

/// One pass over the data, up to whether anything is wrong: what explanations start from.
struct Analysis {
  Evidence evidence;
  Hypotheses hypotheses;
  Alarm alarm;
};

/// The pass without these rows.
Analysis analyse(const Inquiry& inquiry, const std::vector<GrossRow>& gross);

}  // namespace tunica::diagnosis
