// SPDX-License-Identifier: Apache-2.0
#include "data/header_words.hpp"

#include "data/words.hpp"

namespace tunica::data {
namespace {

/// 1 or 2, of the number beside "pk" or "piola": that of a specimen or a cycle says nothing. 0: there is none.
int piola_kirchhoff(const std::vector<std::string>& words) {
  const auto number = [](const std::string& word) {
    return word == "1" || word == "first" || word == "i" ? 1 : word == "2" || word == "second" || word == "ii" ? 2 : 0;
  };
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != "pk" && words[i].find("piola") == std::string::npos) continue;
    std::size_t before = i, after = i + 1;
    while (before > 0 && (words[before - 1] == "st" || words[before - 1] == "nd")) --before;
    while (after < words.size() && words[after].starts_with("kirchhoff")) ++after;
    if (before > 0 && number(words[before - 1]) > 0) return number(words[before - 1]);
    if (after < words.size() && number(words[after]) > 0) return number(words[after]);
  }
  return 0;
}

}  // namespace

std::string strain_measure(const std::vector<std::string>& words) {
  if (has_any(words, {"=true", "=log", "logarithmic", "hencky", "natural", "=ln", "=wahre"})) return "true";
  if (has_any(words, {"=green", "lagrange", "lagrangian"})) return "green";
  if (has_any(words, {"almansi", "eulerian"})) return "almansi";
  if (has_any(words, {"engineering", "=eng", "nominal", "nominelle", "=nenn", "technische", "biot"}))
    return "engineering";
  return {};
}

std::string stress_measure(const std::vector<std::string>& words) {
  if (has_any(words, {"piola", "=pk"})) {
    const int kind = piola_kirchhoff(words);
    return kind == 2 ? "second_piola_kirchhoff" : kind == 1 ? "first_piola_kirchhoff" : "";
  }
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
