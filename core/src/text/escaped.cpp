// SPDX-License-Identifier: Apache-2.0
#include "text/escaped.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace tunica::text {

namespace {

constexpr std::size_t longest_word = 600, longest_message = 20000;  // bytes; a path of a file may have many

struct Character {
  char32_t code = 0;
  std::size_t bytes = 1;
  bool valid = false;
};

/// The first character of a text that is not empty. Table 3-7 of the Unicode standard: no overlong forms, no
/// surrogates, nothing above U+10FFFF.
Character first(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t length = lead >= 0xC2 && lead < 0xE0 ? 2 : lead >= 0xE0 && lead < 0xF0 ? 3 : lead >= 0xF0 ? 4 : 0;
  if (length == 0 || lead > 0xF4 || text.size() < length) return {};
  char32_t code = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = (code << 6) | (byte(i) & 0x3FU);
  }
  constexpr std::array<char32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  if (code < least.at(length) || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return {};
  return {code, length, true};
}

/// Controls C0, DEL and C1; the marks and embeddings of the bidirectional algorithm; the two separators of lines.
bool acts(char32_t code) {
  return code < 0x20 || (code >= 0x7F && code <= 0x9F) || code == 0x61C || code == 0x200E || code == 0x200F ||
         (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

/// Where a text of `limit` bytes may end without cutting a character.
std::size_t whole_characters(std::string_view text, std::size_t limit) {
  std::size_t end = std::min(text.size(), limit);
  for (std::size_t back = 0; back < 3 && end > 0 && end < text.size(); ++back, --end)
    if ((static_cast<unsigned char>(text[end]) & 0xC0U) != 0x80U) break;
  return end;
}

/// Words that no terminal has room for, cut short.
std::string shorter_words(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n"), text.size());
    const std::size_t shown = end > longest_word ? whole_characters(text, longest_word) : end;
    result.append(text.substr(0, shown)).append(shown < end ? "…" : "");
    if (end < text.size()) result += text[end];
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const Character next = first(text);
    if (!next.valid) return false;
    text.remove_prefix(next.bytes);
  }
  return true;
}

bool is_plain(std::string_view text) {
  while (!text.empty()) {
    const Character next = first(text);
    if (!next.valid || acts(next.code)) return false;
    text.remove_prefix(next.bytes);
  }
  return true;
}

std::string escaped(std::string_view text, std::string_view keep) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Character next = first(text);
    const bool kept = next.valid && next.bytes == 1 && keep.find(text.front()) != std::string_view::npos;
    if (!next.valid)
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    else if (kept || !acts(next.code))
      result.append(text.substr(0, next.bytes));
    else if (next.code == '\n' || next.code == '\r' || next.code == '\t')
      result.append(next.code == '\n' ? "\\n" : next.code == '\r' ? "\\r" : "\\t");
    else if (next.code < 0x80)
      result += fmt::format("\\x{:02x}", static_cast<unsigned>(next.code));
    else
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(next.code));
    text.remove_prefix(next.bytes);
  }
  return result;
}

std::string excerpt(std::string_view text, std::size_t limit) {
  const std::size_t end = whole_characters(text, limit);
  return escaped(text.substr(0, end)) + (end < text.size() ? "…" : "");
}

std::string message(std::string_view text) {
  const std::size_t end = whole_characters(text, longest_message);
  std::string shown = shorter_words(escaped(text.substr(0, end), "\n"));
  return end < text.size() ? shown + "…" : shown;
}

std::string json_problem(std::string_view what) {
  if (const auto end = what.find("] "); what.starts_with("[json.exception.") && end != std::string_view::npos)
    what.remove_prefix(end + 2);
  return excerpt(what, 300);
}

std::string plain_json(std::string json) {
  if (is_plain(json)) return json;
  std::string result;
  for (std::string_view rest = json; !rest.empty();) {
    const Character next = first(rest);
    if (next.valid && next.code >= 0x7F && acts(next.code))
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(next.code));
    else
      result.append(rest.substr(0, next.bytes));
    rest.remove_prefix(next.bytes);
  }
  return result;
}

}  // namespace tunica::text
