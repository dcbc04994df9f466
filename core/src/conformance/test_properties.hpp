// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "conformance/verdict.hpp"
#include "tunica/test.hpp"

/// The properties every Test must have. What each means for an author, and why its tolerance: docs/plugin-check.md.
namespace tunica::conformance {

/// A test, a model, and parameters at which the evaluation succeeds.
struct Simulation {
  const Test& test;
  const Model& model;
  std::vector<double> model_parameters, test_parameters;
  std::vector<const Model*> layers = {};

  [[nodiscard]] TestInput input() const { return {model, model_parameters, test_parameters, {}, layers}; }
};

/// Outputs that are wanted are written, every one of them, and no memory beside them is.
Verdict writes_its_outputs_and_nothing_else(const Simulation& simulation, std::uint64_t seed = 0);
/// What is handed in comes back: ok with numbers.
Verdict predictions_are_numbers(const Simulation& simulation, std::uint64_t seed = 0);
/// The Jacobian by model and test parameters against differences, relative to the largest entry of the column in the
/// channel.
Verdict jacobian_matches_differences(const Simulation& simulation, std::uint64_t seed = 0);
/// ∂values/∂abscissa against differences through TestInput::abscissae.
Verdict abscissa_derivative_matches_differences(const Simulation& simulation, std::uint64_t seed = 0);
/// Values do not depend on what else is asked for, and asking for nothing is no error.
Verdict values_do_not_depend_on_the_other_outputs(const Simulation& simulation, std::uint64_t seed = 0);
/// Bound abscissae handed in again give the bound predictions.
Verdict given_abscissae_replace_the_bound_ones(const Simulation& simulation, std::uint64_t seed = 0);
/// The same call answers the same bits, whatever was asked in between.
Verdict predictions_repeat_themselves(const Simulation& simulation, std::uint64_t seed = 0);
/// Threads with the same calls get the same numbers.
Verdict concurrent_predictions_agree(const Simulation& simulation, std::uint64_t seed = 0);
/// With a model that yields no numbers, or none at all: failed, with a reason; no exception.
Verdict failures_are_statuses(const Simulation& simulation, std::uint64_t seed = 0);

/// With parameters at which the energy overflows: failed, with a reason that names a row. Not among the properties
/// below: it needs parameters of its own.
Verdict overflow_is_a_status(const Simulation& simulation);

using TestProperty = PropertyOf<Simulation>;
const std::vector<TestProperty>& test_properties();

}  // namespace tunica::conformance
