// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tunica/test.hpp"

namespace tunica::detail {

/// The status of a test with independent equilibrium rows for a model that it cannot simulate; ok if it can.
inline Status elastic_only(std::string_view test, const TestInput& input, const TestOutput& output) {
  const ModelDescription& model = input.model.describe();
  const std::string name = std::string(test) + ": ";
  if (model.history_size > 0)
    return Status::failed(name +
                          "the model remembers its history, and rows are simulated at equilibrium; choose a model "
                          "without history");
  if (!output.jacobian.empty() && !model.parameter_derivatives)
    return Status::failed(name + "the model has no parameter derivatives; difference the whole prediction");
  return {};
}

}  // namespace tunica::detail
