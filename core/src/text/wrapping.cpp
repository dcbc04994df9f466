// SPDX-License-Identifier: Apache-2.0
#include "text/wrapping.hpp"

#include <algorithm>

#include "text/escaped.hpp"

namespace tunica::text {

namespace {

bool continues_a_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

}  // namespace

std::size_t columns(std::string_view text) {
  return text.size() - static_cast<std::size_t>(std::count_if(text.begin(), text.end(), continues_a_character));
}

std::string pad(std::string_view text, std::size_t width) {
  const std::string shown = escaped(text, "\n");
  const std::size_t used = columns(shown);
  return shown + std::string(used < width ? width - used : 0, ' ');
}

std::string pad_left(std::string_view text, std::size_t width) {
  const std::string shown = escaped(text, "\n");
  const std::size_t used = columns(shown);
  return std::string(used < width ? width - used : 0, ' ') + shown;
}

std::string shortened(std::string_view text, std::size_t width) {
  std::string shown = escaped(text);
  if (columns(shown) <= width) return shown;
  if (width == 0) return {};
  std::size_t end = 0, used = 0;
  while (end < shown.size() && (used < width - 1 || continues_a_character(shown[end])))
    used += !continues_a_character(shown[end++]);
  return shown.substr(0, end) + "…";
}

std::string hanging(std::string_view lead, std::string_view text, std::size_t width) {
  std::string shown_lead, shown;
  if (!is_plain(lead)) lead = shown_lead = escaped(lead, "\n");
  if (!is_plain(text)) text = shown = escaped(text, "\n");
  constexpr std::size_t short_enough = 20;
  const std::size_t margin = std::min(lead.find_first_not_of(' '), lead.size());
  if (columns(lead) > std::max(width / 2, short_enough) && margin < lead.size() &&
      text.find_first_not_of(" \n") != std::string_view::npos)
    return hanging(lead.substr(0, margin), lead.substr(margin), width) + '\n' + hanging("    ", text, width);
  const std::size_t indent = columns(lead);
  std::string result(lead);
  std::size_t used = indent;
  bool first_word = true;
  while (!text.empty()) {
    const std::size_t end = text.find_first_of(" \n");
    const std::string_view word = text.substr(0, end);
    const bool line_end = end != std::string_view::npos && text[end] == '\n';
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (!word.empty()) {
      const std::size_t length = columns(word);
      if (!first_word && used + 1 + length > width) {
        result += '\n' + std::string(indent, ' ');
        used = indent;
        first_word = true;
      }
      if (!first_word) {
        result += ' ';
        ++used;
      }
      result += word;
      used += length;
      first_word = false;
    }
    if (line_end) {
      result += '\n' + std::string(indent, ' ');
      used = indent;
      first_word = true;
    }
  }
  return result;
}

}  // namespace tunica::text
