// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace tunica::detail {

/// Deepest accepted nesting of JSON; no file of tunica needs more than a dozen levels. The library copies, compares and
/// writes values recursively, so a file of 80 000 brackets would overflow the stack.
inline constexpr std::size_t deepest_json = 64;

/// The position of the bracket that exceeds the nesting limit; npos if none does. It does not check that the text is
/// JSON.
inline std::size_t excess_of_levels(std::string_view text, bool comments = false) {
  std::size_t depth = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"') {
      for (++at; at < text.size() && text[at] != '"'; ++at)
        if (text[at] == '\\') ++at;
    } else if (c == '[' || c == '{') {
      if (++depth > deepest_json) return at;
    } else if (c == ']' || c == '}') {
      if (depth > 0) --depth;
    } else if (comments && c == '/' && at + 1 < text.size()) {
      const bool line = text[at + 1] == '/';
      if (!line && text[at + 1] != '*') continue;
      const std::size_t end = line ? text.find_first_of("\r\n", at) : text.find("*/", at + 2);
      if (end == std::string_view::npos) break;
      at = end;
    }
  }
  return std::string_view::npos;
}

/// As parse() of the JSON library, for untrusted text: nesting deeper than 64 levels is a parse_error, or gives a
/// discarded value without `exceptions`.
template <class Json = nlohmann::json>
Json parse_json(std::string_view text, bool exceptions = true, bool comments = false) {
  const std::size_t excess = excess_of_levels(text, comments);
  if (excess == std::string_view::npos) return Json::parse(text, nullptr, exceptions, comments);
  if (!exceptions) return Json(Json::value_t::discarded);
  throw Json::parse_error::create(101, excess + 1, "more than " + std::to_string(deepest_json) + " levels of nesting",
                                  nullptr);
}

}  // namespace tunica::detail
