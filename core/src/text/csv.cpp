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

}  // namespace

std::string csv_cell(std::string_view text) {
  const std::string plain = escaped(text);
  const bool acts = plain.size() > 1 && formula.find(plain.front()) != std::string_view::npos && !is_number(plain);
  std::string cell = acts ? "'" : "";
  for (const char character : plain) {
    cell += character;
    if (character == '"') cell += '"';
  }
  return plain.find_first_of(",\"") == std::string::npos ? cell : '"' + cell + '"';
}

std::string_view cell_text(std::string_view cell) {
  if (cell.size() > 2 && cell.front() == '\'' && formula.find(cell[1]) != std::string_view::npos) cell.remove_prefix(1);
  return cell;
}

}  // namespace tunica::text
