// SPDX-License-Identifier: Apache-2.0
#include "renamed.hpp"

#include <cctype>
#include <regex>

namespace tunica::app {
namespace {

/// "grip_compliance" → "GripCompliance"
std::string pascal_case(const std::string& name) {
  std::string text;
  bool upper = true;
  for (const char character : name) {
    if (character == '_') {
      upper = true;
      continue;
    }
    text += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(character))) : character;
    upper = false;
  }
  return text;
}

}  // namespace

std::string renamed(const std::string& text, const std::string& example, const std::string& name) {
  const std::regex word("\\b" + example + "\\b"), class_name("\\b" + pascal_case(example) + "(?=[A-Z])");
  return std::regex_replace(std::regex_replace(text, word, name), class_name, pascal_case(name));
}

}  // namespace tunica::app
