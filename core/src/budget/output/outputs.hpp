// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "budget/budget.hpp"
#include "text/styled.hpp"

namespace tunica::budget {

/// "6.9 %", "0.24 %"
std::string percent(double share);

/// "stated", "default", "scatter between the repeats"
const char* origin_words(const Tolerance& tolerance);

/// `diagnosis.budget` of result.json.
nlohmann::ordered_json budget_json(const Budget& budget);

/// What a person reads below the verdict: the misfit of the base, what each cause takes, what is left. `base`: the name
/// of the base model.
text::StyledText summary(const Budget& budget, const std::string& base);

/// The text of extended.json: the base with everything that was fitted; empty where nothing was.
std::string extended_experiment(const Budget& budget, const diagnosis::Diagnosis& diagnosis,
                                const plugins::Catalogue& catalogue);

}  // namespace tunica::budget
