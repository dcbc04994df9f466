// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "budget/budget.hpp"
#include "diagnosis/naming/explanation.hpp"

namespace tunica::budget {

/// What to do after a verdict that leaves something open, in one or two sentences: first what the file could say and
/// does not, which costs no experiment. Empty where the verdict asks for nothing.
std::string next_step(const Budget& budget, const diagnosis::Explanation& explanation);

}  // namespace tunica::budget
