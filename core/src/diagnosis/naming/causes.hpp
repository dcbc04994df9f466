// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "diagnosis/naming/refits.hpp"

namespace tunica::diagnosis {

/// Addition `which` of a refit in words and numbers: amplitude with its interval from the refit's Jacobian, what it has
/// to do with the parameters, the sentence for a person. The probabilities are left to whoever compares.
Cause cause_of(const Inquiry& inquiry, const Analysis& analysis, const Refit& refit, std::size_t which,
               const Direction& direction);

/// The sentence, from the numbers of the cause.
std::string explanation_of(const Cause& cause, const MechanismFactory& mechanism);

/// Where an effect that several tests should show is carried by one of them: what the rest shows instead. Leaving one
/// test out, amplitude δ becomes δ₋ with standard errors s and s₋; δ₋ − δ has variance s₋² − s² if the effect is what
/// it is said to be. More than 3.5 of its standard deviations, with δ₋ no longer significant where it should be, is no
/// chance.
std::optional<std::string> carried_by_one_test(const Analysis& analysis, const Direction& direction);

}  // namespace tunica::diagnosis
