// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/file/inspection.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include <fmt/format.h>

namespace tunica::diagnosis {
namespace {

/// Findings that speak of the file, not of the specimen.
constexpr std::array bookkeeping{data::FindingKind::record_repeated, data::FindingKind::record_coarse,
                                 data::FindingKind::record_sign,     data::FindingKind::record_percent,
                                 data::FindingKind::record_angle,    data::FindingKind::record_time};

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

std::vector<Suspect> inspected(const Evidence& evidence) {
  std::vector<Suspect> found;
  for (const data::Finding& finding : evidence.base->layout().findings)
    if (std::find(bookkeeping.begin(), bookkeeping.end(), finding.kind) != bookkeeping.end())
      found.push_back({std::string(text::code_of(data::finding_codes, finding.kind)), finding.text});
  for (const std::string& name : evidence.run.tests) {
    const experiment::TestEntry& test = evidence.experiment.test(name);
    for (const auto& [declared, header] : test.data.columns) {
      const HeaderWords words = words_of_header(header);
      if (declared.starts_with("stress") && !words.measure.empty() && words.measure != test.data.stress_measure)
        found.push_back({"header_measure",
                         fmt::format("the header '{}' of '{}' speaks of \"{}\", and the file declares \"{}\". Which is "
                                     "it? Write \"stress_measure\": \"{}\" where the header is right",
                                     header, name, words.measure, test.data.stress_measure, words.measure)});
      const bool strain = declared.find("strain") != std::string::npos || declared.starts_with("stretch");
      if (strain && !words.definition.empty() && !declared.starts_with(words.definition))
        found.push_back(
            {"header_strain",
             fmt::format("the header '{}' of '{}' speaks of \"{}\", and the file maps it as \"{}\". Which is "
                         "it? Map it as \"{}\" where the header is right",
                         header, name, words.definition, declared, words.definition)});
    }
  }
  return found;
}

}  // namespace tunica::diagnosis
