// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "data/csv.hpp"
#include "importing/columns.hpp"
#include "importing/proposal.hpp"
#include "tunica/plugin.hpp"

namespace tunica::importing {

/// The title of a mapped column that holds a force per length, as the tension of a membrane; empty where there is none.
/// `mapped`: quantity and column. Throws InputError if there is a force beside it, or a size that does not go with it.
std::string tension_of(const data::Csv& csv, const std::vector<ColumnGuess>& columns,
                       const std::vector<std::pair<std::string, std::string>>& mapped, const TestFactory& factory,
                       const Answers& answers);

}  // namespace tunica::importing
