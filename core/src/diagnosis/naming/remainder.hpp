// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/naming/refits.hpp"

namespace tunica::diagnosis {

/// Calibrated on the development seed of the blind benchmark, see docs/diagnosis.md: what an explanation leaves is
/// clean above this p-value, and a further mechanism has to be needed at this level.
constexpr double second_alpha = 0.01;

inline bool is_clean(double p_after) { return p_after > second_alpha; }

/// Tests the residuals of a refit for everything that was not added: smooth shapes and the other mechanisms. If
/// `outliers` is added at one row, the other rows are still tested.
Detector remainder_detector(const Analysis& analysis, const Refit& refit);

/// P-value of what a refit leaves.
double p_of_remainder(const Analysis& analysis, const Refit& refit);

/// How much larger than it is stated the noise would have to be for the rest to be clean, up to 20 times; and whether
/// the base fit would be wrong at that noise too. None: it would not be clean.
struct CleanAt {
  double factor = 1;
  bool base_still_wrong = false;
};
std::optional<CleanAt> noise_that_explains_remainder(const Inquiry& inquiry, const Analysis& analysis,
                                                     const Refit& refit);

}  // namespace tunica::diagnosis
