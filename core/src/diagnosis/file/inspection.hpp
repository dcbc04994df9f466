// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

/// What shows without a fit: blocks of rows that stand in a file twice, values on a coarse grid, signs, percent,
/// radians and times that no such test has; and words in the header of a column that say another stress or strain than
/// the file declares.
std::vector<Suspect> inspected(const Evidence& evidence);

/// What a header says against the declaration of its column; nothing where it says nothing of the kind.
struct HeaderWords {
  std::string measure;     ///< "cauchy", "first_piola_kirchhoff", "second_piola_kirchhoff" or empty
  std::string definition;  ///< "true_strain", "green_strain", "strain" or empty
};
HeaderWords words_of_header(const std::string& header);

}  // namespace tunica::diagnosis
