// SPDX-License-Identifier: Apache-2.0
#include "data/header_words.hpp"

#include "data/words.hpp"

namespace tunica::data {

std::string strain_measure(const std::vector<std::string>& words) {
  if (has_any(words, {"=true", "=log", "logarithmic", "hencky", "natural", "=ln", "=wahre"})) return "true";
  if (has_any(words, {"=green", "lagrange", "lagrangian"})) return "green";
  if (has_any(words, {"almansi", "eulerian"})) return "almansi";
  if (has_any(words, {"engineering", "=eng", "nominal", "nominelle", "=nenn", "technische", "biot"}))
    return "engineering";
  return {};
}

std::string stress_measure(const std::vector<std::string>& words) {
  if (has_any(words, {"piola", "=pk"}))
    return has_any(words, {"=2", "=second", "=ii"}) ? "second_piola_kirchhoff"
           : has_any(words, {"=1", "=first", "=i"}) ? "first_piola_kirchhoff"
                                                    : "";
  if (has_any(words, {"cauchy", "=true", "=wahre"})) return "cauchy";
  if (has_any(words, {"engineering", "=eng", "nominal", "=nenn", "technische"})) return "first_piola_kirchhoff";
  return {};
}

HeaderWords words_of_header(const std::string& header) {
  const std::vector<std::string> words = words_of(header);
  if (!has_any(words, {"strain", "dehnung", "hencky", "logarithmic", "lagrange"})) return {stress_measure(words), {}};
  const std::string strain = strain_measure(words);
  return {{},
          strain == "true"          ? "true_strain"
          : strain == "green"       ? "green_strain"
          : strain == "engineering" ? "strain"
                                    : ""};
}

}  // namespace tunica::data
