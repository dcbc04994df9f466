// SPDX-License-Identifier: Apache-2.0
#include "conformance/model_properties.hpp"

namespace tunica::conformance {

const std::vector<ModelProperty>& model_properties() {
  static const std::vector<ModelProperty> properties{
      {"stress_is_the_gradient_of_the_energy", stress_is_the_gradient_of_the_energy},
      {"tangent_is_the_derivative_of_the_stress", tangent_is_the_derivative_of_the_stress},
      {"tangent_has_its_symmetries", tangent_has_its_symmetries},
      {"parameter_derivatives_match_differences", parameter_derivatives_match_differences},
      {"response_is_objective", response_is_objective},
      {"response_has_the_symmetry_of_the_wall", response_has_the_symmetry_of_the_wall, true},
      {"deviatoric_stress_vanishes_at_rest", deviatoric_stress_vanishes_at_rest},
      {"energy_is_the_sum_of_its_parts", energy_is_the_sum_of_its_parts},
      {"numbers_are_finite_or_say_so", numbers_are_finite_or_say_so},
      {"writes_its_outputs_and_nothing_else", writes_its_outputs_and_nothing_else},
      {"batch_equals_single_points", batch_equals_single_points},
      {"unwanted_outputs_change_nothing", unwanted_outputs_change_nothing},
      {"calls_leave_nothing_behind", calls_leave_nothing_behind},
      {"concurrent_calls_agree", concurrent_calls_agree},
      {"axes_path_agrees_with_tensors", axes_path_agrees_with_tensors},
      {"axes_parameter_derivatives_agree_with_tensors", axes_parameter_derivatives_agree_with_tensors},
      {"axes_energy_derivatives_match_differences", axes_energy_derivatives_match_differences},
      {"axes_memory_agrees_with_tensors", axes_memory_agrees_with_tensors},
      {"history_begins_at_rest", history_begins_at_rest},
      {"history_tangent_is_the_derivative_of_the_step", history_tangent_is_the_derivative_of_the_step},
      {"history_stands_still_without_time", history_stands_still_without_time}};
  return properties;
}

}  // namespace tunica::conformance
