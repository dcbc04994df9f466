// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include "assembly/composition.hpp"
#include "evaluation.hpp"
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
    const Parameter& declared = slot.declaration;
    const experiment::ParameterSetting* const setting = slot.setting;
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

py::dict evaluate_material(const Material& material, const Array& deformations, const Array& parameters,
                           const Array& time_step, bool tangent) {
  const auto values = vector_of(parameters, material.description().parameters.size(), "parameters");
  return evaluate_points(*material.composed.model, values, deformations, time_step, tangent);
}

}  // namespace

void add_material(py::module_& module) {
  py::class_<Material>(module, "Material")
      .def(py::init(&material_of))
      .def_property_readonly("type", [](const Material& self) { return self.entry.type; })
      .def_property_readonly("parameters", &parameters_of_material)
      .def_property_readonly("remembers", [](const Material& self) { return self.description().history_size > 0; })
      .def("evaluate", &evaluate_material);
  py::class_<MaterialOfTest, std::shared_ptr<MaterialOfTest>>(module, "MaterialOfTest")
      .def("evaluate", &MaterialOfTest::evaluate);
}

}  // namespace tunica::python
