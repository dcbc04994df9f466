// SPDX-License-Identifier: Apache-2.0
#include "data/header_words.hpp"

#include <cctype>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace tunica::data {
namespace {

/// Lower case, with a blank for whatever is no letter or digit, and a blank at both ends.
std::string plain(const std::string& header) {
  std::string words = " ";
  for (const char letter : header) {
    const auto byte = static_cast<unsigned char>(letter);
    words += std::isalnum(byte) != 0 ? static_cast<char>(std::tolower(byte)) : ' ';
  }
  return words + ' ';
}

using Vocabulary = std::vector<std::pair<const char*, const char*>>;

std::string first_of(const Vocabulary& vocabulary, const std::string& words) {
  for (const auto& [word, meaning] : vocabulary)
    if (words.find(fmt::format(" {} ", word)) != std::string::npos) return meaning;
  return {};
}

}  // namespace

HeaderWords words_of_header(const std::string& header) {
  static const Vocabulary measures{{"cauchy", "cauchy"},
                                   {"true stress", "cauchy"},
                                   {"pk1", "first_piola_kirchhoff"},
                                   {"1pk", "first_piola_kirchhoff"},
                                   {"first piola", "first_piola_kirchhoff"},
                                   {"nominal", "first_piola_kirchhoff"},
                                   {"engineering stress", "first_piola_kirchhoff"},
                                   {"eng stress", "first_piola_kirchhoff"},
                                   {"pk2", "second_piola_kirchhoff"},
                                   {"2pk", "second_piola_kirchhoff"},
                                   {"second piola", "second_piola_kirchhoff"}};
  static const Vocabulary definitions{
      {"true strain", "true_strain"},   {"log strain", "true_strain"},    {"logarithmic", "true_strain"},
      {"hencky", "true_strain"},        {"green strain", "green_strain"}, {"green lagrange", "green_strain"},
      {"engineering strain", "strain"}, {"eng strain", "strain"},         {"nominal strain", "strain"}};
  const std::string words = plain(header);
  HeaderWords found{first_of(measures, words), first_of(definitions, words)};
  if (!found.definition.empty()) found.measure.clear();
  return found;
}

}  // namespace tunica::data
