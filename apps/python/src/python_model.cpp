// SPDX-License-Identifier: Apache-2.0
#include "python_model.hpp"

#include <utility>
#include <vector>

#include "arrays.hpp"
#include "tunica/detail/symmetric_strip.hpp"

namespace tunica::python {

namespace py = pybind11;

namespace {

/// One output of an evaluation under the name that Python knows it by.
struct Output {
  const char* name;
  std::span<double> into;
};

/// Requests the outputs that are not empty, and copies the results.
Status answer(const py::object& object, const char* method, std::span<const double> points, std::size_t components,
              std::size_t count, std::span<const double> parameters, std::span<const Output> outputs) {
  py::list wanted;
  for (const Output& output : outputs)
    if (!output.into.empty()) wanted.append(output.name);
  const py::object result = object.attr(method)(matrix_of(points, components, count), array_of(parameters), wanted);
  for (const Output& output : outputs) {
    if (output.into.empty()) continue;
    const auto values = result[output.name].cast<Array>();
    if (static_cast<std::size_t>(values.size()) != output.into.size())
      return Status::failed(fmt::format("{}() returned {} numbers for '{}', expected {}", method, values.size(),
                                        output.name, output.into.size()));
    std::copy_n(values.data(), output.into.size(), output.into.begin());
  }
  return {};
}

void add(std::span<double> into, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) into[i] += values[i];
}

/// Room for a second answer of the same size.
std::vector<double> like(std::span<const double> wanted) { return std::vector<double>(wanted.size()); }

}  // namespace

Status PythonModel::evaluate(const MaterialPoints& points, const MaterialResponse& response) const {
  const Output outputs[] = {{"energy", response.energy},
                            {"stress", response.stress},
                            {"tangent", response.tangent},
                            {"stress_dp", response.stress_dp}};
  return guarded_call(
      owner_, [&] { return answer(object_.get(), "evaluate", points.C, 6, points.count, points.parameters, outputs); });
}

Status PythonModel::evaluate_axes(const AxisPoints& points, const AxisResponse& response) const {
  const Output outputs[] = {{"energy", response.energy},
                            {"gradient", response.gradient},
                            {"hessian", response.hessian},
                            {"gradient_dp", response.gradient_dp},
                            {"energy_dp", response.energy_dp}};
  return guarded_call(owner_, [&] {
    return answer(object_.get(), "evaluate_axes", points.c, 3, points.count, points.parameters, outputs);
  });
}

AddedPythonEnergy::AddedPythonEnergy(std::unique_ptr<Model> base, std::unique_ptr<PythonModel> added, double null)
    : base_(std::move(base)),
      added_(std::move(added)),
      description_(base_->describe()),
      own_(description_.parameters.size()),
      null_(null) {
  const auto& own = added_->describe();
  description_.parameters.insert(description_.parameters.end(), own.parameters.begin(), own.parameters.end());
  description_.principal_axes = description_.principal_axes && own.principal_axes;
  description_.axis_history_size = 0;  // the path in principal axes would have to know the energy beside it
}

// The rows of derivatives by the parameters of the base come first, those by the own ones after them: both models write
// their part of the same span.
Status AddedPythonEnergy::evaluate(const MaterialPoints& points, const MaterialResponse& response) const {
  const std::size_t of_base = response.stress_dp.empty() ? 0 : 6 * points.count * own_;
  MaterialPoints bare = points;
  bare.parameters = points.parameters.first(own_);
  MaterialResponse of_bare = response;
  of_bare.stress_dp = response.stress_dp.first(of_base);
  if (Status status = base_->evaluate(bare, of_bare); !status.ok()) return status;
  const auto own_dp = response.stress_dp.subspan(of_base);
  if (points.parameters[own_] == null_ && own_dp.empty()) return {};
  auto energy = like(response.energy), stress = like(response.stress), tangent = like(response.tangent);
  Status status = added_->evaluate({points.count, points.C, points.parameters.subspan(own_), {}, {}},
                                   {energy, stress, tangent, own_dp, {}});
  if (!status.ok() || points.parameters[own_] == null_) return status;
  add(response.energy, energy);
  add(response.stress, stress);
  add(response.tangent, tangent);
  return {};
}

Status AddedPythonEnergy::evaluate_axes(const AxisPoints& points, const AxisResponse& response) const {
  const std::size_t gradients = response.gradient_dp.empty() ? 0 : 3 * points.count * own_;
  const std::size_t energies = response.energy_dp.empty() ? 0 : points.count * own_;
  AxisResponse of_bare = response;
  of_bare.gradient_dp = response.gradient_dp.first(gradients);
  of_bare.energy_dp = response.energy_dp.first(energies);
  if (Status status = base_->evaluate_axes({points.count, points.c, points.parameters.first(own_)}, of_bare);
      !status.ok())
    return status;
  const auto own_dp = response.gradient_dp.subspan(gradients), own_energy = response.energy_dp.subspan(energies);
  if (points.parameters[own_] == null_ && own_dp.empty() && own_energy.empty()) return {};
  auto energy = like(response.energy), gradient = like(response.gradient), hessian = like(response.hessian);
  Status status = added_->evaluate_axes({points.count, points.c, points.parameters.subspan(own_)},
                                        {energy, gradient, hessian, own_dp, own_energy});
  if (!status.ok() || points.parameters[own_] == null_) return status;
  add(response.energy, energy);
  add(response.gradient, gradient);
  add(response.hessian, hessian);
  return {};
}

bool AddedPythonEnergy::solve_strip(const StripPath& strip, Status& status) const {
  if (strip.parameters[own_] != null_ || !strip.stress_dp.empty() || !description_.principal_axes) return false;
  StripPath bare = strip;
  bare.parameters = strip.parameters.first(own_);
  if (free_strip::symmetry_of_parts(*base_, bare.parameters) == free_strip::Symmetry::isotropic) return false;
  return base_->solve_strip(bare, status);
}

}  // namespace tunica::python
