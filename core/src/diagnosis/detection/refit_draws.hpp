// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "diagnosis/detection/detector.hpp"
#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// (1 + number of worse draws)/(draws + 1). Each draw is simulated from the base fit without any hidden effect, fitted
/// again, and tested like the measured data. It includes the curvature of the model, which the linear calibration
/// neglects. Draws run in parallel, each with its own noise seed.
double p_from_refits(const Inquiry& inquiry, const Evidence& evidence, const Detector& detector,
                     const Detection& measured, std::size_t draws);

}  // namespace tunica::diagnosis
