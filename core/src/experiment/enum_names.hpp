// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment/experiment.hpp"

/// What the values of enumerations are called in the experiment file.
namespace tunica::experiment {

template <class Enumeration, std::size_t count>
using EnumNames = std::array<std::pair<Enumeration, std::string_view>, count>;

inline constexpr EnumNames<ObjectiveType, 3> objective_names{
    {{ObjectiveType::standardised_quadratic, "standardised_quadratic"},
     {ObjectiveType::least_squares, "least_squares"},
     {ObjectiveType::sum_of_norms, "sum_of_norms"}}};

inline constexpr EnumNames<OnFailure, 3> on_failure_names{
    {{OnFailure::penalise, "penalise"}, {OnFailure::stop, "stop"}, {OnFailure::retry, "retry"}}};

inline constexpr EnumNames<Scale, 2> scale_names{{{Scale::linear, "linear"}, {Scale::log, "log"}}};

/// All names, in the order of the table.
template <class Enumeration, std::size_t count>
std::vector<std::string> names_in(const EnumNames<Enumeration, count>& table) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.emplace_back(entry.second);
  return names;
}

/// Every value has a name.
template <class Enumeration, std::size_t count>
std::string_view name_in(const EnumNames<Enumeration, count>& table, Enumeration value) {
  for (const auto& entry : table)
    if (entry.first == value) return entry.second;
  return {};
}

/// The value of a name that stands in the table.
template <class Enumeration, std::size_t count>
Enumeration value_in(const EnumNames<Enumeration, count>& table, std::string_view name) {
  for (const auto& entry : table)
    if (entry.second == name) return entry.first;
  return table.front().first;
}

}  // namespace tunica::experiment
