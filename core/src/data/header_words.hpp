// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tunica::data {

/// What the header of a column says of what stands in it; empty = nothing.
struct HeaderWords {
  std::string measure;     ///< "cauchy", "first_piola_kirchhoff", "second_piola_kirchhoff"
  std::string definition;  ///< of the strain: "strain", "true_strain", "green_strain"
};
HeaderWords words_of_header(const std::string& header);

}  // namespace tunica::data
