// SPDX-License-Identifier: Apache-2.0
#include "text_template.hpp"

#include <fmt/format.h>

namespace tunica::external {
namespace {

constexpr std::string_view blanks = " \t";
constexpr std::size_t longest_place = 200;  ///< bytes; so the work grows with the text, whatever braces stand in it

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool is_name(std::string_view text) {
  if (text.empty() || (text.front() >= '0' && text.front() <= '9')) return false;
  return text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") ==
         std::string_view::npos;
}

}  // namespace

TextTemplate::TextTemplate(std::string_view text) {
  std::string piece;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find("{{", at);
    if (open == std::string::npos) {
      piece += text.substr(at);
      break;
    }
    const std::size_t length = text.substr(open, longest_place).find("}}");
    const std::size_t close = length == std::string::npos ? open + 2 : open + length;
    const std::string_view inside = trimmed(text.substr(open + 2, close - open - 2));
    const std::size_t blank = inside.find_first_of(blanks);
    const std::string_view name = inside.substr(0, blank);
    if (!is_name(name) || inside.find('\n') != std::string::npos) {  // braces of the solver's own language
      piece += text.substr(at, open + 1 - at);
      at = open + 1;
      continue;
    }
    piece += text.substr(at, open - at);
    pieces_.push_back(std::move(piece));
    piece.clear();
    places_.push_back(
        {std::string(name), std::string(blank == std::string::npos ? "" : trimmed(inside.substr(blank)))});
    at = close + 2;
  }
  pieces_.push_back(std::move(piece));
}

std::string TextTemplate::filled(const std::function<std::string(const Place&)>& value) const {
  std::string text = pieces_.front();
  for (std::size_t k = 0; k < places_.size(); ++k) text += value(places_[k]) + pieces_[k + 1];
  return text;
}

std::string number(double value) {
  constexpr std::size_t widest = 19;
  std::string text = fmt::format("{}", value);
  for (int digits = 16; text.size() > widest; --digits) text = fmt::format("{:.{}g}", value, digits);
  return text;
}

}  // namespace tunica::external
