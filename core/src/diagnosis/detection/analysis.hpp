// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnosis/detection/alarm.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/hypotheses/hypotheses.hpp"

namespace tunica::diagnosis {

/// One pass over the data up to the alarm. Explanations start from it.
struct Analysis {
  Evidence evidence;
  Hypotheses hypotheses;
  Alarm alarm;
};

/// The pass without these rows. Unstated noise is first estimated from neighbouring rows. When the hypotheses are
/// known, it is estimated outside their span, and evidence and hypotheses are recomputed with it.
Analysis analyse(const Inquiry& inquiry, const std::vector<GrossRow>& gross);

/// The pass with the noise estimated from an extension's residuals; none if no noise is estimated, or if no σ changes
/// by more than a tenth.
std::optional<Analysis> restated(const Inquiry& inquiry, const Analysis& analysis, const Fit& extension);

}  // namespace tunica::diagnosis
