// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

/// Enumerations that files carry as codes: stable snake_case words that scripts and the report decide by.
namespace tunica::text {

template <class Enumeration>
struct Code {
  Enumeration value;
  std::string_view code;
};

template <class Enumeration, std::size_t count>
using Codes = std::array<Code<Enumeration>, count>;

/// "" for a value that the table lacks.
template <class Enumeration, std::size_t count>
constexpr std::string_view code_of(const Codes<Enumeration, count>& table, Enumeration value) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const auto& entry) { return entry.value == value; });
  return found == table.end() ? std::string_view() : found->code;
}

/// Nothing for a word that the table lacks, from a newer version for example.
template <class Enumeration, std::size_t count>
constexpr std::optional<Enumeration> value_of(const Codes<Enumeration, count>& table, std::string_view code) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const auto& entry) { return entry.code == code; });
  return found == table.end() ? std::nullopt : std::optional(found->value);
}

}  // namespace tunica::text
