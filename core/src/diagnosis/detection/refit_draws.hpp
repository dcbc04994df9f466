// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "diagnosis/detection/detector.hpp"
#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// (1 + draws that look worse)/(draws + 1): data simulated from the base fit with nothing hidden in them, each fitted
/// again and tested like the measured ones. What the linear calibration leaves out, the curvature of the model, is in
/// it. Draws side by side, each with a noise of its own number.
double p_from_refits(const Inquiry& inquiry, const Evidence& evidence, const Detector& detector,
                     const Detection& measured, std::size_t draws);

}  // namespace tunica::diagnosis
