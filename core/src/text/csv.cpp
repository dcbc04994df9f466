// SPDX-License-Identifier: Apache-2.0
#include "text/csv.hpp"

namespace tunica::text {

std::string csv_cell(std::string_view text) {
  std::string cell;
  for (const char character : text) {
    cell += character == '\n' || character == '\r' ? ' ' : character;
    if (character == '"') cell += '"';
  }
  return text.find_first_of(",\"") == std::string_view::npos ? cell : '"' + cell + '"';
}

}  // namespace tunica::text
