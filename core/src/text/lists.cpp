// SPDX-License-Identifier: Apache-2.0
#include "text/lists.hpp"

#include <cctype>

namespace tunica::text {

std::string joined(std::span<const std::string> items) {
  std::string text;
  for (std::size_t k = 0; k < items.size(); ++k)
    text.append(k == 0 ? "" : k + 1 < items.size() ? ", " : " and ").append(items[k]);
  return text;
}

std::string_view agreeing(std::size_t count, std::string_view one, std::string_view many) {
  return count == 1 ? one : many;
}

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return std::to_string(count).append(" ").append(agreeing(count, one, many));
}

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace tunica::text
