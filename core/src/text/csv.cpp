// SPDX-License-Identifier: Apache-2.0
#include "text/csv.hpp"

#include <algorithm>

#include "text/escaped.hpp"

namespace tunica::text {

namespace {

constexpr std::string_view formula = "=+-@'";

/// Digits with at most a point or a comma, and a power of ten: what a spreadsheet does not calculate either.
bool is_number(std::string_view text) {
  const auto digits = [&text] {
    const auto end = std::min(text.find_first_not_of("0123456789"), text.size());
    text.remove_prefix(end);
    return end;
  };
  const auto sign = [&text] {
    if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
  };
  sign();
  if (text == "inf" || text == "nan") return true;
  std::size_t count = digits();
  if (!text.empty() && (text.front() == '.' || text.front() == ',')) {
    text.remove_prefix(1);
    count += digits();
  }
  if (count == 0) return false;
  if (!text.empty() && (text.front() == 'e' || text.front() == 'E')) {
    text.remove_prefix(1);
    sign();
    if (digits() == 0) return false;
  }
  return text.empty();
}

std::string_view between_blanks(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of(" \t"), text.size());
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

}  // namespace

std::string csv_cell(std::string_view text) {
  const std::string plain = escaped(text);
  // A reader takes blanks off both ends: what is left must tell a mark of ours from an apostrophe of the text.
  const std::string_view core = between_blanks(plain);
  const bool acts = core.size() > 1 && formula.find(core.front()) != std::string_view::npos && !is_number(core);
  std::string cell;
  for (const char& character : plain) {
    if (acts && &character == core.data()) cell += '\'';
    cell += character;
    if (character == '"') cell += '"';
  }
  return plain.find_first_of(",\"") == std::string::npos ? cell : '"' + cell + '"';
}

std::string cell_text(std::string_view cell) {
  std::string text(cell);
  const std::string_view core = between_blanks(cell);
  if (core.size() > 2 && core.front() == '\'' && formula.find(core[1]) != std::string_view::npos)
    text.erase(static_cast<std::size_t>(core.data() - cell.data()), 1);
  return text;
}

}  // namespace tunica::text
