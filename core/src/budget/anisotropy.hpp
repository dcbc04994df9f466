// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::budget {

/// What the data say by themselves, without a model: two directions of a specimen answer differently at equal
/// stretches, by more than five standard deviations and more than `tolerance` of the range. In sheets these are rows
/// with the same stretch in both directions, for strips cut along two directions the stretches that both reach. "at
/// stretch 1.12 in both directions, the test 'sheet' has 18 kPa along the circumference and 39 kPa along the axis";
/// empty where they do not.
std::string anisotropy_words(const diagnosis::Evidence& evidence, double tolerance);

}  // namespace tunica::budget
