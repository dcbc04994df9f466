// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// (1 + draws that look worse)/(draws + 1): data simulated from the base fit with nothing hidden in them, each fitted
/// again and judged like the measured ones. What the linear calibration leaves out, the curvature of the model, is in
/// it. Draws side by side, each with a noise of its own number.
double p_from_refits(const Diagnosis& diagnosis, const Detection& detection, std::size_t draws);

/// 95 % intervals of the amplitudes of the extension from refits of data simulated from it: percentiles of 199.
void refine_intervals(Diagnosis& diagnosis, const plugins::Catalogue& catalogue);

}  // namespace tunica::diagnosis
