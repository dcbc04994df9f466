// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "importing/columns.hpp"
#include "importing/proposal.hpp"
#include "tunica/test.hpp"

/// Whether a specimen was pulled, or pressed with values that count compression positive.
namespace tunica::importing {

/// What the name of a file, the lines above its table and the names of its columns say.
struct SignWords {
  bool compression = false, tension = false;
  bool bending = false;   ///< of the file or above its table, where no column says so
  bool negative = false;  ///< every force is, but for some that scatter about zero
};
SignWords words_of_sign(const std::filesystem::path& file, std::string_view bytes, const data::Csv& csv,
                        const std::vector<ColumnGuess>& columns);

/// The question, where no word says and only the specimen hints at it: it is nearly as thick as it is long, and its
/// forces and displacements are positive. `data` has "columns" and "specimen".
std::optional<Question> question_of_sign(const Json& data, const data::Csv& csv,
                                         const std::vector<const data::Csv::Row*>& rows,
                                         const std::vector<Observable>& observables);

}  // namespace tunica::importing
