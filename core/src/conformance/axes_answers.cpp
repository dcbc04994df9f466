// SPDX-License-Identifier: Apache-2.0
#include "conformance/axes_answers.hpp"

#include <stdexcept>

#include "conformance/handout.hpp"

namespace tunica::conformance {

AxesAnswers axes_answers(const Model& model, std::span<const double> c, std::span<const double> parameters,
                         const AxesSelection& wanted) {
  const ModelDescription& description = model.describe();
  const std::size_t n = c.size() / 3;
  const std::size_t derivatives = wanted.gradient_dp && description.parameter_derivatives ? n * parameters.size() : 0;
  const bool energies = wanted.energy_dp && description.energy_derivatives;
  Handout handout("the model, in evaluate_axes(),");
  const AxisPoints points{n, handout.input("c", c), handout.input("parameters", parameters)};
  const AxisResponse out{
      handout.output("energy", wanted.energy ? n : 0), handout.output("gradient", wanted.gradient ? 3 * n : 0),
      handout.output("hessian", wanted.hessian ? 6 * n : 0), handout.output("gradient_dp", 3 * derivatives),
      handout.output("energy_dp", energies ? derivatives : 0)};
  const Status status = model.evaluate_axes(points, out);
  handout.verify(status.ok());
  if (!status.ok()) throw std::runtime_error("evaluate_axes answers '" + status.reason() + "'");
  const auto copy = [](std::span<const double> output) { return std::vector<double>(output.begin(), output.end()); };
  return {copy(out.energy), copy(out.gradient), copy(out.hessian), copy(out.gradient_dp), copy(out.energy_dp)};
}

}  // namespace tunica::conformance
