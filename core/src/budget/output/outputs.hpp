// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "budget/budget.hpp"
#include "text/misfit_words.hpp"
#include "text/styled.hpp"

namespace tunica::budget {

using text::percent;

/// "stated", "default", "scatter between the repeats"
const char* origin_words(const Tolerance& tolerance);

/// " in the test 'strip'" after the name of a cause; empty where it acts on the material.
std::string place_words(const diagnosis::Place& place);

/// "the misfit", or that it is within the tolerance.
std::string the_misfit(const Budget& budget);

/// "2.3 % of the range remains (tolerance 2.0 %, default), for which no cause is claimed"
std::string remains(const Size& rest, const Tolerance& tolerance);

/// " (with 4 parameters of its own, probability 0.03)" of another state; empty of other causes, which bring one or two.
std::string price(const Contender& contender);

/// The registered model that the base with its causes is, as a line below the verdict; empty where there is none.
text::StyledText same_model_line(const Budget& budget, const std::string& base);

/// `diagnosis.budget` of result.json.
nlohmann::ordered_json budget_json(const Budget& budget);

/// What a person reads below the verdict: the misfit of the base, what each cause takes, what is left. `base`: the name
/// of the base model.
text::StyledText summary(const Budget& budget, const std::string& base);

/// The text of extended.json: the base with everything that was fitted; empty where nothing was.
std::string extended_experiment(const Budget& budget, const diagnosis::Diagnosis& diagnosis,
                                const plugins::Catalogue& catalogue);

}  // namespace tunica::budget
