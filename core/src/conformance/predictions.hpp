// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "conformance/test_properties.hpp"

namespace tunica::conformance {

using Values = std::vector<double>;

inline std::size_t size_of(const Simulation& s) { return s.test.rows().count * s.test.rows().channels.size(); }

/// Which outputs are asked for.
struct PredictionSelection {
  bool values = true, jacobian = false, abscissa_derivative = false, diagnostics = false;
};
/// The results of a test. They are valid only if the status is ok.
struct Prediction {
  Status status;
  Values values, jacobian, abscissa_derivative, diagnostics;
};
/// A call of predict(). Throws MemoryFault (handout.hpp) for writes elsewhere, or left out under the status ok.
Prediction predict(const Test& test, const TestInput& input, const PredictionSelection& wanted = {});

/// Predictions at the test's own abscissae, or with abscissa k replaced by `other`. Throws std::runtime_error where
/// the status is not ok.
Values values_at(const Simulation& s, const Values& p, const Values& q, const Values& other = {}, std::size_t k = 0);

/// Largest entry of a column within the channel that row i belongs to.
double channel_scale(const Simulation& s, std::span<const double> column, std::size_t i);

/// "row 3 (stretch = 1.2), channel stress": of entry i of the predictions.
std::string place(const Simulation& s, std::size_t i);

/// The name of a parameter, the model's first, then the test's.
std::string parameter_name(const Simulation& s, std::size_t j);

}  // namespace tunica::conformance
