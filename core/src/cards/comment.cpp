// SPDX-License-Identifier: Apache-2.0
#include "cards/comment.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "text/wrapping.hpp"

namespace tunica::cards {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 25> spellings{
    {{"λ", "lambda"}, {"μ", "mu"},     {"µ", "mu"},   {"α", "alpha"}, {"κ", "kappa"}, {"θ", "theta"}, {"ψ", "psi"},
     {"χ", "chi"},    {"Δ", "delta "}, {"ν", "nu"},   {"σ", "sigma"}, {"√", "sqrt"},  {"²", "^2"},    {"³", "^3"},
     {"·", "*"},      {"×", "x"},      {"±", "+-"},   {"−", "-"},     {"–", "-"},     {"—", "-"},     {"…", "..."},
     {"≤", "<="},     {"≥", ">="},     {"°", " deg"}, {"½", "1/2"}}};

}  // namespace

std::string ascii(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    const auto byte = static_cast<unsigned char>(text.front());
    if (byte < 0x80) {
      plain += byte >= 0x20 && byte != 0x7f ? text.front() : '?';
      text.remove_prefix(1);
      continue;
    }
    std::string_view written = "?";
    std::size_t length = 1;
    while (length < text.size() && (static_cast<unsigned char>(text[length]) & 0xC0u) == 0x80u) ++length;
    for (const auto& [sign, spelling] : spellings)
      if (text.starts_with(sign)) written = spelling;
    plain += written;
    text.remove_prefix(length);
  }
  return plain;
}

std::string comment(std::string_view lead, std::string_view paragraph) {
  const std::string wrapped = text::hanging("", ascii(paragraph), 75 - lead.size());
  std::string lines;
  std::string_view rest = wrapped;
  bool first = true;
  while (!rest.empty()) {
    const auto end = rest.find('\n');
    lines += fmt::format("{} {}{}\n", lead, first ? "" : "  ", rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    first = false;
  }
  return lines;
}

std::string comments(std::string_view lead, std::span<const std::string> paragraphs) {
  std::string lines;
  for (const auto& paragraph : paragraphs) lines += comment(lead, paragraph);
  return lines;
}

std::string xml_comment(std::span<const std::string> paragraphs) {
  std::string lines = comments("", paragraphs);
  for (std::size_t at = 0; (at = lines.find("--", at)) != std::string::npos;) lines.replace(at, 2, "- -");
  return "<!--\n" + lines + "-->\n";
}

std::string number(double value) {
  constexpr std::size_t widest = 19;
  std::string text;
  for (int digits = 15; text.empty() || text.size() > widest; --digits) text = fmt::format("{:.{}g}", value, digits);
  return text;
}

}  // namespace tunica::cards
