// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "assembly/composition.hpp"
#include "experiment/reader.hpp"
#include "library.hpp"
#include "module.hpp"
#include "tunica/error.hpp"

namespace tunica::python {

namespace {

using namespace py::literals;

/// A model with its mechanisms, as an entry of "models" describes it, without any test.
struct Material {
  std::shared_ptr<const plugins::Catalogue> catalogue;
  experiment::ModelEntry entry;
  assembly::ComposedModel composed;

  [[nodiscard]] const ModelDescription& description() const { return composed.model->describe(); }
};

std::unique_ptr<Material> material_of(const Library& library, std::string text) {
  auto material = std::make_unique<Material>();
  material->catalogue = library.catalogue();
  const experiment::JsonDocument document("<model>", std::move(text));
  std::vector<experiment::SharedParameter> shared;
  material->entry = experiment::read_model("model", experiment::Node(document), *material->catalogue, shared);
  material->composed = assembly::compose_model(material->entry, *material->catalogue, "");
  return material;
}

py::list parameters_of_material(const Material& material) {
  py::list all;
  for (const auto& slot : material.composed.slots) {
    const auto& [declared, setting, null] = slot;
    const auto said = [](const std::optional<double>& value, double otherwise) { return value.value_or(otherwise); };
    const bool has = setting != nullptr;
    const double initial = has ? said(setting->fixed, said(setting->initial, declared.initial)) : declared.initial;
    all.append(py::dict("name"_a = declared.name, "unit"_a = declared.unit,
                        "min"_a = has ? said(setting->min, declared.min) : declared.min,
                        "max"_a = has ? said(setting->max, declared.max) : declared.max, "initial"_a = initial,
                        "scale"_a = declared.scale == Scale::log ? "log" : "linear", "doc"_a = declared.doc));
  }
  return all;
}

/// C of n points, component-major as MaterialPoints has it, and what is wanted of the response in the same layout.
py::dict evaluate_material(const Material& material, const Array& deformations, const Array& parameters,
                           const Array& times, bool tangent, bool stress_dp) {
  const std::size_t n = static_cast<std::size_t>(deformations.size()) / 6;
  const auto p = vector_of(parameters, material.description().parameters.size(), "parameters");
  const std::size_t history = material.description().history_size;
  std::vector<double> energy(n), stress(6 * n), by_deformation(tangent ? 36 * n : 0),
      by_parameter(stress_dp ? 6 * n * p.size() : 0);
  Status status;
  {
    const py::gil_scoped_release free;
    const std::span<const double> all(deformations.data(), 6 * n), steps = span_of(times);
    if (history == 0) {
      status =
          material.composed.model->evaluate({n, all, p, {}, {}}, {energy, stress, by_deformation, by_parameter, {}});
    } else {
      // With memory the points are the steps of one path, each from the state after the one before.
      std::vector<double> before, after(history);
      for (std::size_t i = 0; i < n && status.ok(); ++i) {
        double point[6], found_energy[1], found_stress[6];
        for (std::size_t c = 0; c < 6; ++c) point[c] = all[c * n + i];
        status = material.composed.model->evaluate({1, point, p, steps.empty() ? steps : steps.subspan(i, 1), before},
                                                   {found_energy, found_stress, {}, {}, after});
        energy[i] = found_energy[0];
        for (std::size_t c = 0; c < 6; ++c) stress[c * n + i] = found_stress[c];
        before = after;
      }
    }
  }
  py::dict found;
  found["status"] = name(status.kind());
  found["reason"] = status.reason();
  found["energy"] = array_of(energy);
  found["stress"] = matrix_of(stress, 6, n);
  if (tangent) found["tangent"] = matrix_of(by_deformation, 36, n);
  if (stress_dp) found["stress_dp"] = matrix_of(by_parameter, 6 * p.size(), n);
  return found;
}

}  // namespace

void add_material(py::module_& module) {
  py::class_<Material>(module, "Material")
      .def(py::init(&material_of))
      .def_property_readonly("type", [](const Material& self) { return self.entry.type; })
      .def_property_readonly("parameters", &parameters_of_material)
      .def_property_readonly("remembers", [](const Material& self) { return self.description().history_size > 0; })
      .def("evaluate", &evaluate_material);
}

}  // namespace tunica::python
