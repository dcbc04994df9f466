// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiment/experiment.hpp"
#include "text/codes.hpp"

/// The names of enumeration values in the experiment file.
namespace tunica::experiment {

inline constexpr text::Codes<ObjectiveType, 3> objective_names{
    {{ObjectiveType::standardised_quadratic, "standardised_quadratic"},
     {ObjectiveType::least_squares, "least_squares"},
     {ObjectiveType::sum_of_norms, "sum_of_norms"}}};

inline constexpr text::Codes<OnFailure, 3> on_failure_names{
    {{OnFailure::penalise, "penalise"}, {OnFailure::stop, "stop"}, {OnFailure::retry, "retry"}}};

inline constexpr text::Codes<KeptEvaluations, 2> kept_evaluations_names{
    {{KeptEvaluations::all, "all"}, {KeptEvaluations::improvements, "improvements"}}};

inline constexpr text::Codes<Scale, 2> scale_names{{{Scale::linear, "linear"}, {Scale::log, "log"}}};

/// All names, in the order of the table.
template <class Enumeration, std::size_t count>
std::vector<std::string> names_in(const text::Codes<Enumeration, count>& table) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.emplace_back(entry.code);
  return names;
}

}  // namespace tunica::experiment
