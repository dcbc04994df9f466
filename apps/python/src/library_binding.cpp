// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>

#include "data/nearest.hpp"
#include "library.hpp"
#include "module.hpp"
#include "plugins/description.hpp"
#include "tunica/error.hpp"

namespace tunica::python {

namespace {

using json = nlohmann::ordered_json;

const std::string& doc_of(const MechanismFactory& factory) { return factory.cause; }
template <class Factory>
const std::string& doc_of(const Factory& factory) {
  return factory.doc;
}

template <class Shelf>
std::map<std::string, std::string> docs_of(const Shelf& shelf) {
  std::map<std::string, std::string> docs;
  for (const auto& [name, entry] : shelf) docs[name] = doc_of(entry.factory);
  return docs;
}

/// JSON text of the declarations of the types with this name, by kind.
std::string describe(const Library& library, const std::string& name) {
  const auto catalogue = library.catalogue();
  json document = json::object();
  std::vector<std::string> known;
  const auto look = [&](const char* kind, const auto& shelf) {
    for (const auto& [entry_name, entry] : shelf) {
      known.push_back(entry_name);
      if (entry_name == name) document[kind] = plugins::description_json(entry);
    }
  };
  look("model", catalogue->models());
  look("test", catalogue->tests());
  look("optimizer", catalogue->optimizers());
  look("mechanism", catalogue->mechanisms());
  if (document.empty()) throw InputError("nothing is called '" + name + "'. " + data::suggestion(name, known));
  return document.dump(2, ' ', false, json::error_handler_t::replace);
}

}  // namespace

void add_library(py::module_& module) {
  py::class_<Loaded, std::shared_ptr<Loaded>>(module, "Experiment")
      .def_property_readonly("name", [](const Loaded& self) { return self.experiment.name; })
      .def_property_readonly("seed", [](const Loaded& self) { return self.experiment.seed; })
      .def_property_readonly("given_json", [](const Loaded& self) { return self.given_json; })
      .def_property_readonly("folder", [](const Loaded& self) {
        return std::filesystem::absolute(self.experiment.file).parent_path().lexically_normal().string();
      });
  py::class_<Library>(module, "Library")
      .def(py::init<const std::vector<std::string>&, const std::string&, bool>())
      .def_property_readonly("refusals", &Library::refusals)
      .def("read", &Library::read)
      .def("parse", &Library::parse)
      .def("forget", &Library::forget)
      .def("describe", &describe)
      .def("schema", [](const Library& self) { return experiment::compose_schema(*self.catalogue()); })
      .def("list", [](const Library& self) {
        const auto catalogue = self.catalogue();
        return std::map<std::string, std::map<std::string, std::string>>{
            {"models", docs_of(catalogue->models())},
            {"tests", docs_of(catalogue->tests())},
            {"optimizers", docs_of(catalogue->optimizers())},
            {"mechanisms", docs_of(catalogue->mechanisms())}};
      });
}

}  // namespace tunica::python
