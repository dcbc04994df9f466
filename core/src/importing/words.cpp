// SPDX-License-Identifier: Apache-2.0
#include "importing/words.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tunica::importing {

std::string as_name(std::string text) {
  for (char& letter : text)
    if (letter == '.' || letter == '/' || letter == '\\' || letter == ' ') letter = '_';
  if (text.empty() || text.front() == '-') text = "test" + text;
  return text;
}

std::string listed(const std::vector<std::string>& values) {
  std::vector<std::string> shown(values.begin(),
                                 values.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(values.size(), 8)));
  return fmt::format("{}{}", fmt::join(shown, ", "), values.size() > shown.size() ? ", …" : "");
}

}  // namespace tunica::importing
