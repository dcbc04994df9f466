// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// What the words of a header (words.hpp) say of what stands in its column; empty = nothing.
namespace tunica::data {

/// "true", "green", "almansi", "engineering".
std::string strain_measure(const std::vector<std::string>& words);

/// "cauchy", "first_piola_kirchhoff", "second_piola_kirchhoff".
std::string stress_measure(const std::vector<std::string>& words);

struct HeaderWords {
  std::string measure;     ///< of the stress, as above
  std::string definition;  ///< of the strain, as an experiment file has it: "strain", "true_strain", "green_strain"
};
HeaderWords words_of_header(const std::string& header);

}  // namespace tunica::data
