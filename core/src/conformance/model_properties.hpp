// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "conformance/verdict.hpp"
#include "tunica/card_energy.hpp"
#include "tunica/model.hpp"

/// The properties every Model must have. What each means for an author, and why its tolerance: docs/plugin-check.md.
namespace tunica::conformance {

Verdict stress_is_the_gradient_of_the_energy(const Model& model, std::uint64_t seed);
Verdict tangent_is_the_derivative_of_the_stress(const Model& model, std::uint64_t seed);
Verdict tangent_has_its_symmetries(const Model& model, std::uint64_t seed);
Verdict parameter_derivatives_match_differences(const Model& model, std::uint64_t seed);

Verdict response_is_objective(const Model& model, std::uint64_t seed);
Verdict response_has_the_symmetry_of_the_wall(const Model& model, std::uint64_t seed);
Verdict deviatoric_stress_vanishes_at_rest(const Model& model, std::uint64_t seed);
Verdict energy_is_the_sum_of_its_parts(const Model& model, std::uint64_t seed);
Verdict numbers_are_finite_or_say_so(const Model& model, std::uint64_t seed);

Verdict writes_its_outputs_and_nothing_else(const Model& model, std::uint64_t seed);
Verdict batch_equals_single_points(const Model& model, std::uint64_t seed);
Verdict unwanted_outputs_change_nothing(const Model& model, std::uint64_t seed);
Verdict calls_leave_nothing_behind(const Model& model, std::uint64_t seed);
Verdict concurrent_calls_agree(const Model& model, std::uint64_t seed);

Verdict axes_path_agrees_with_tensors(const Model& model, std::uint64_t seed);
Verdict axes_parameter_derivatives_agree_with_tensors(const Model& model, std::uint64_t seed);
Verdict axes_memory_agrees_with_tensors(const Model& model, std::uint64_t seed);
Verdict axes_energy_derivatives_match_differences(const Model& model, std::uint64_t seed);

Verdict history_begins_at_rest(const Model& model, std::uint64_t seed);
Verdict history_tangent_is_the_derivative_of_the_step(const Model& model, std::uint64_t seed);
Verdict history_stands_still_without_time(const Model& model, std::uint64_t seed);

/// Of a model whose factory declares a card, made with these options.
Verdict card_has_the_energy_of_the_model(const Model& model, const CardFormula& card, const Options& options,
                                         std::uint64_t seed);

using ModelProperty = PropertyOf<Model>;
/// All of these, in this order.
const std::vector<ModelProperty>& model_properties();

}  // namespace tunica::conformance
