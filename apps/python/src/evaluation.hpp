// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "arrays.hpp"
#include "tunica/test.hpp"

namespace tunica::python {

/// C of n points as MaterialPoints has it, and the response in the same layout: a dictionary with status, reason,
/// energy, stress, and where wanted tangent. Of a model with memory the points are the steps of one path from rest,
/// `time_step` s after each other; without time loading is infinitely slow. With the interpreter's lock, which it gives
/// up while the model computes.
pybind11::dict evaluate_points(const Model& model, std::span<const double> parameters, const Array& deformations,
                               const Array& time_step, bool tangent);

/// The material of one prediction, as a test written in Python sees it: valid until the prediction ends.
class MaterialOfTest {
 public:
  explicit MaterialOfTest(const TestInput& input) : input_(&input) {}
  void expire() { input_ = nullptr; }
  [[nodiscard]] pybind11::dict evaluate(const Array& deformations, const Array& time_step, bool tangent) const;

 private:
  const TestInput* input_;
};

}  // namespace tunica::python
