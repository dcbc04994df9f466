// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// What the data say by themselves, without a model: two directions of a specimen answer differently at equal
/// stretches, by more than five standard deviations and more than `tolerance` of the range. In sheets these are rows
/// with the same stretch in both directions, for strips cut along two directions the stretches that both reach. "two
/// directions answer differently: at stretch 1.12 in both, 18 and 39 kPa …"; empty where they do not.
std::string anisotropy_words(const Evidence& evidence, double tolerance = 0.02);

}  // namespace tunica::diagnosis
