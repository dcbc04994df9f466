// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// Anisotropy that the data show without a model: at equal stretches, two directions of a specimen differ by more than
/// five standard deviations and more than `tolerance` of the range. In sheets it compares rows with the same stretch in
/// both directions. For strips cut along two directions, it compares the stretches that both reach. "two directions
/// answer differently: at stretch 1.12 in both, 18 and 39 kPa …"; empty where they do not.
std::string anisotropy_words(const Evidence& evidence, double tolerance = 0.02);

}  // namespace tunica::diagnosis
