// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tunica/test.hpp"

/// The properties every Test must have, as checks that return an empty string or a counter-example in words.
namespace tunica::testing {

/// A test, a model, and parameters at which the evaluation succeeds.
struct Simulation {
  const Test& test;
  const Model& model;
  std::vector<double> model_parameters, test_parameters;
  std::vector<const Model*> layers = {};

  [[nodiscard]] TestInput input() const { return {model, model_parameters, test_parameters, {}, layers}; }
};

/// The Jacobian by model and test parameters against central differences, 1e-6 relative to the largest entry of the
/// column in the channel.
std::string jacobian_matches_differences(const Simulation& simulation);
/// ∂values/∂abscissa against differences through TestInput::abscissae.
std::string abscissa_derivative_matches_differences(const Simulation& simulation);
/// Values do not depend on what else is asked for (to 1e-10), and asking for nothing is no error.
std::string values_do_not_depend_on_the_other_outputs(const Simulation& simulation);
/// Bound abscissae handed in again give the bound predictions.
std::string given_abscissae_replace_the_bound_ones(const Simulation& simulation);
/// Four threads with the same calls get the same numbers.
std::string concurrent_predictions_agree(const Simulation& simulation);
/// With parameters at which the energy overflows: failed, with a reason that names a row; no exception.
std::string overflow_is_a_status(const Simulation& simulation);

struct TestProperty {
  const char* name;
  std::string (*check)(const Simulation&);
};
/// All but overflow_is_a_status, which needs parameters of its own.
const std::vector<TestProperty>& test_properties();

}  // namespace tunica::testing
