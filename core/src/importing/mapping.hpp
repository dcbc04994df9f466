// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "importing/columns.hpp"
#include "importing/proposal.hpp"

/// Which column gives which quantity of a test.
namespace tunica::importing {

struct Mapping {
  Pairs columns;  ///< quantity → column, as "columns" of the data has them
  Json units = Json::object();
  std::string stress_measure;  ///< as the name of the stress says it; empty = it does not
  bool compression = false;    ///< a mapped column speaks of compression
  std::vector<std::string> notes;
};

/// What the answers name goes first and is not guessed again; of several columns of one quantity the likeliest is
/// taken, and the others are listed. Throws InputError where a quantity that the test needs has no column, and where a
/// name contradicts an answer.
Mapping map_columns(const data::Csv& csv, const std::vector<ColumnGuess>& columns, const TestFactory& factory,
                    const Answers& answers, const Ask& ask);

}  // namespace tunica::importing
