// SPDX-License-Identifier: Apache-2.0
#include "text/lists.hpp"

#include <algorithm>
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

std::string capitalised(std::string text, std::span<const std::string> names) {
  const std::size_t end = std::min(text.find(' '), text.size());
  const std::string_view word = std::string_view(text).substr(0, text.find_last_not_of(",;:.", end - 1) + 1);
  const bool name = word.find_first_of("_.0123456789") != std::string_view::npos ||
                    std::find(names.begin(), names.end(), word) != names.end();
  if (!text.empty() && !name) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace tunica::text
