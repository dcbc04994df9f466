// SPDX-License-Identifier: Apache-2.0
#include "plugins/declared_bounds.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tunica/error.hpp"

namespace tunica::plugins {
namespace {

bool fits(const Option& option) {
  using Kind = Option::Kind;
  switch (option.kind) {
    case Kind::flag:
      return std::holds_alternative<bool>(*option.fallback);
    case Kind::integer:
      return std::holds_alternative<std::int64_t>(*option.fallback);
    case Kind::number:
    case Kind::quantity:
      return std::holds_alternative<double>(*option.fallback);
    case Kind::choice:
    case Kind::text:
    case Kind::json:
      return std::holds_alternative<std::string>(*option.fallback);
  }
  return false;
}

std::optional<double> number_in(const Option::Value& value) {
  if (const double* number = std::get_if<double>(&value)) return *number;
  if (const std::int64_t* number = std::get_if<std::int64_t>(&value)) return static_cast<double>(*number);
  return {};
}

}  // namespace

std::string flaw_of_default(const Option& option) {
  if (!option.fallback) return {};
  if (!fits(option))
    return fmt::format("the option '{}' has a default of another kind than it declares; expected one of its own kind",
                       option.name);
  if (option.kind == Option::Kind::choice) {
    const std::string& word = std::get<std::string>(*option.fallback);
    if (std::find(option.choices.begin(), option.choices.end(), word) != option.choices.end()) return {};
    return fmt::format("the option '{}' has the default '{}', which is none of its choices; expected one of '{}'",
                       option.name, word, fmt::join(option.choices, "', '"));
  }
  const std::optional<double> number = number_in(*option.fallback);
  if (!number) return {};
  if (option.min && !(*number >= *option.min))
    return fmt::format("the option '{}' has the default {}, outside its own bounds; expected {} or more", option.name,
                       *number, *option.min);
  if (option.max && !(*number <= *option.max))
    return fmt::format("the option '{}' has the default {}, outside its own bounds; expected {} or less", option.name,
                       *number, *option.max);
  return {};
}

std::string flaw_of_default(const Parameter& parameter) {
  if (parameter.initial >= parameter.min && parameter.initial <= parameter.max) return {};
  return fmt::format("the parameter '{}' begins at {}, outside its own bounds; expected a value from {} to {}",
                     parameter.name, parameter.initial, parameter.min, parameter.max);
}

void refuse_equal_names(const std::vector<Parameter>& parameters, const std::string& plugin, const char* noun) {
  std::set<std::string> names;
  for (const Parameter& parameter : parameters)
    if (!names.insert(parameter.name).second)
      throw InputError(fmt::format(
          "plugin '{}' made a {} with two parameters named '{}', so that a file cannot say which one it means. "
          "Give its parts names that differ, or report this to its author",
          plugin, noun, parameter.name));
}

}  // namespace tunica::plugins
