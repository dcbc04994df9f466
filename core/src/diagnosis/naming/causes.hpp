// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "diagnosis/naming/refits.hpp"

namespace tunica::diagnosis {

/// Addition `which` of a refit in words and numbers: the amplitude with its interval from the refit's Jacobian, its
/// coupling to the parameters, and the sentence for people. The caller adds the probabilities.
Cause cause_of(const Inquiry& inquiry, const Analysis& analysis, const Refit& refit, std::size_t which,
               const Direction& direction);

/// The sentence, from the numbers of the cause.
std::string explanation_of(const Cause& cause, const MechanismFactory& mechanism);

/// If only one of several tests shows an effect that all should show: the result from the other tests. Without one
/// test, amplitude δ becomes δ₋, with standard errors s and s₋. If the effect is as claimed, δ₋ − δ has variance s₋² −
/// s². A difference above 3.5 standard deviations is not chance if δ₋ should be significant and is not.
std::optional<std::string> carried_by_one_test(const Analysis& analysis, const Direction& direction);

}  // namespace tunica::diagnosis
