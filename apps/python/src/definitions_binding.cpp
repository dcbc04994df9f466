// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include "declared.hpp"
#include "kept.hpp"
#include "library.hpp"
#include "module.hpp"
#include "python_model.hpp"
#include "tunica/error.hpp"

namespace tunica::python {

namespace {

ModelDescription model_description(const py::dict& declared, const std::string& type) {
  ModelDescription description;
  description.type = type;
  description.parameters = parameters_from(declared["parameters"], "'" + type + "'");
  description.principal_axes = declared["principal_axes"].cast<bool>();
  description.energy_derivatives = description.principal_axes;
  return description;
}

/// An object of the class for these options.
std::unique_ptr<PythonModel> make_model(const Kept& maker, const ModelDescription& description,
                                        const Options& options) {
  const std::string owner = "'" + description.type + "', defined in Python";
  return guarded_making(
      owner, [&] { return std::make_unique<PythonModel>(description, Kept(maker.get()(**keywords_of(options)))); });
}

void define_model(Library& library, const py::dict& declared) {
  ModelFactory factory;
  factory.type = declared["name"].cast<std::string>();
  factory.doc = declared["doc"].cast<std::string>();
  factory.reference = declared["reference"].cast<std::string>();
  factory.options = options_from(declared["options"], "'" + factory.type + "'");
  factory.create = [description = model_description(declared, factory.type),
                    maker = Kept(declared["make"])](const Options& options) -> std::unique_ptr<Model> {
    return make_model(maker, description, options);
  };
  library.define(std::move(factory));
}

}  // namespace

void add_definitions(py::module_& module) { module.def("define_model", &define_model); }

}  // namespace tunica::python
