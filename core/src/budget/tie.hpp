// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "budget/budget.hpp"

/// Causes of which none is clearly ahead: what is printed, the ambiguity set and the next experiment name the same.
namespace tunica::budget {

using Ties = std::vector<const Contender*>;

/// What a tie is between: of what is first, one of each answer. The same mechanism in another place is another answer.
Ties tied(const Ties& first);

/// "alone, these take so much of the misfit that none is clearly ahead: …"
std::string tie_words(const Budget& budget, const Ties& ties);

/// The ambiguity set: ids, and in words the places as well. `unseen`: look-alikes that were not looked for.
void claim_tie(const Ties& ties, const std::vector<std::string>& unseen, diagnosis::Claim& claim);

/// What switches a cause by itself; empty where nothing does.
std::string isolated_by(const std::string& id, const plugins::Catalogue& catalogue);

/// What switches each mechanism of a tie by itself, with its places. What nobody would believe asks for no test.
std::vector<std::string> switches(const Ties& ties, const plugins::Catalogue& catalogue);

}  // namespace tunica::budget
