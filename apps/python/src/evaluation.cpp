// SPDX-License-Identifier: Apache-2.0
#include "evaluation.hpp"

#include <vector>

namespace tunica::python {

namespace py = pybind11;

namespace {

/// Step by step, each from the state after the one before.
Status follow(const Model& model, std::span<const double> parameters, std::span<const double> path,
              std::span<const double> steps, std::span<double> energy, std::span<double> stress) {
  const std::size_t n = energy.size();
  std::vector<double> before, after(model.describe().history_size);
  for (std::size_t i = 0; i < n; ++i) {
    double point[6], found_energy[1], found_stress[6];
    for (std::size_t c = 0; c < 6; ++c) point[c] = path[c * n + i];
    const auto step = steps.empty() ? steps : steps.subspan(i, 1);
    if (Status status =
            model.evaluate({1, point, parameters, step, before}, {found_energy, found_stress, {}, {}, after});
        !status.ok())
      return status;
    energy[i] = found_energy[0];
    for (std::size_t c = 0; c < 6; ++c) stress[c * n + i] = found_stress[c];
    before = after;
  }
  return {};
}

}  // namespace

py::dict evaluate_points(const Model& model, std::span<const double> parameters, const Array& deformations,
                         const Array& time_step, bool tangent) {
  if (tangent && model.describe().history_size > 0)
    throw InputError("the model has memory, and its tangent depends on the path; take differences along one");
  const bool keeps_volume = model.keeps_volume(parameters);
  if (model.describe().compressible && keeps_volume) {
    const Model& bare = model.incompressible();
    return evaluate_points(bare, parameters.first(bare.describe().parameters.size()), deformations, time_step, tangent);
  }
  const std::size_t n = static_cast<std::size_t>(deformations.size()) / 6;
  std::vector<double> energy(n), stress(6 * n), by_deformation(tangent ? 36 * n : 0);
  const std::span<const double> points(deformations.data(), 6 * n), steps = span_of(time_step);
  Status status;
  {
    const py::gil_scoped_release free;
    status = model.describe().history_size == 0
                 ? model.evaluate({n, points, parameters, {}, {}}, {energy, stress, by_deformation, {}, {}})
                 : follow(model, parameters, points, steps, energy, stress);
  }
  py::dict found;
  found["status"] = name(status.kind());
  found["reason"] = status.reason();
  found["keeps_volume"] = keeps_volume;
  found["energy"] = array_of(energy);
  found["stress"] = matrix_of(stress, 6, n);
  if (tangent) found["tangent"] = matrix_of(by_deformation, 36, n);
  return found;
}

py::dict MaterialOfTest::evaluate(const Array& deformations, const Array& time_step, bool tangent) const {
  if (input_ == nullptr)
    throw InputError(
        "the material of a prediction is gone when the prediction has ended; take what you need of it before");
  return evaluate_points(input_->model, input_->model_parameters, deformations, time_step, tangent);
}

}  // namespace tunica::python
