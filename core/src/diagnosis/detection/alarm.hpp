// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "diagnosis/detection/detector.hpp"
#include "diagnosis/hypotheses/hypotheses.hpp"

namespace tunica::diagnosis {

/// Whether anything is wrong with the base fit, and the detector that tests it.
struct Alarm {
  Shapes shapes;
  Draws draws;
  std::shared_ptr<const Detector> detector;  ///< of the residuals of the base fit
  Detection detection;
  std::optional<double> p_refits;  ///< from full refits; none where it is quick
  bool raised = false;
  std::optional<double> factor;  ///< times the noise up to which the alarm stands

  [[nodiscard]] double p() const { return p_refits.value_or(detection.p); }
  /// p() is an upper bound: this many refits cannot resolve smaller p-values.
  [[nodiscard]] bool p_is_bound() const { return p_refits && detection.p < *p_refits && *p_refits < 0.001; }
};

Alarm alarm_of(const Inquiry& inquiry, const Evidence& evidence, const Hypotheses& hypotheses);

}  // namespace tunica::diagnosis
