// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

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

/// The pass without these rows. Noise that nobody stated is first that of neighbouring rows; when the hypotheses are
/// there, it is estimated outside of them all, and evidence and hypotheses are stated again by it.
Analysis analyse(const Inquiry& inquiry, const std::vector<GrossRow>& gross);

/// The pass with the noise that an extension's residuals say there is; none where nothing is estimated, or σ of no
/// channel changes by more than a tenth.
std::optional<Analysis> restated(const Inquiry& inquiry, const Analysis& analysis, const Fit& extension);

}  // namespace tunica::diagnosis
