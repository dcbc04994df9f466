// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cctype>
#include <string>

namespace tunica::cards {

/// The model's name as a card can have it.
inline std::string card_name(const std::string& model) {
  std::string name;
  for (const char c : model) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  if (name.empty() || !std::isalpha(static_cast<unsigned char>(name.front()))) name = "M_" + name;
  return name.substr(0, 40);
}

}  // namespace tunica::cards
