// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include "declared.hpp"
#include "kept.hpp"
#include "library.hpp"
#include "module.hpp"
#include "python_model.hpp"
#include "python_optimizer.hpp"
#include "python_test.hpp"
#include "tunica/error.hpp"

namespace tunica::python {

namespace {

std::string owner_of(const std::string& name) { return "'" + name + "', defined in Python"; }

/// What all factories have in common.
template <class Factory>
void fill_in(Factory& factory, const py::dict& declared) {
  factory.type = declared["name"].cast<std::string>();
  factory.doc = declared["doc"].cast<std::string>();
  factory.reference = declared["reference"].cast<std::string>();
  factory.options = options_from(declared["options"], owner_of(factory.type));
}

/// A mechanism declares no "compressible".
ModelDescription model_description(const py::dict& declared, const std::string& type) {
  ModelDescription description;
  description.type = type;
  description.parameters = parameters_from(declared["parameters"], owner_of(type));
  description.principal_axes = declared["principal_axes"].cast<bool>();
  description.energy_derivatives = description.principal_axes;
  if (declared.contains("compressible")) description.compressible = declared["compressible"].cast<bool>();
  return description;
}

/// An object of the definition for these options.
Kept made(const Kept& maker, const std::string& type, const Options& options) {
  return guarded_making(owner_of(type), [&] { return Kept(maker.get()(**keywords_of(options))); });
}

std::unique_ptr<PythonModel> make_model(const Kept& maker, const ModelDescription& description,
                                        const Options& options) {
  return std::make_unique<PythonModel>(description, made(maker, description.type, options));
}

void define_model(Library& library, const py::dict& declared) {
  ModelFactory factory;
  fill_in(factory, declared);
  factory.create = [description = model_description(declared, factory.type),
                    maker = Kept(declared["make"])](const Options& options) -> std::unique_ptr<Model> {
    return make_model(maker, description, options);
  };
  library.define(std::move(factory));
}

void define_test(Library& library, const py::dict& declared) {
  TestFactory factory;
  fill_in(factory, declared);
  factory.observables = observables_from(declared["observables"], owner_of(factory.type));
  factory.parameters = parameters_from(declared["parameters"], owner_of(factory.type));
  TestDescription description;
  description.parameters = factory.parameters;
  description.nulls.assign(factory.parameters.size(), std::numeric_limits<double>::quiet_NaN());
  description.costly = declared["costly"].cast<bool>();
  description.volume = TestDescription::Volume::either;  // J is what its author makes of it
  factory.create = [type = factory.type, description,
                    maker = Kept(declared["make"])](const TestSetup& setup) -> std::unique_ptr<Test> {
    auto object = guarded_making(owner_of(type), [&] {
      py::list abscissae;
      for (const auto& column : setup.rows.abscissae) abscissae.append(column.observable);
      const py::dict rows(py::arg("abscissae") = abscissae, py::arg("channels") = setup.rows.channels,
                          py::arg("count") = setup.rows.count, py::arg("stress_measure") = setup.stress_measure,
                          py::arg("time") = std::vector<double>(setup.rows.time.begin(), setup.rows.time.end()));
      return Kept(maker.get()(rows, **keywords_of(setup.options)));
    });
    return std::make_unique<PythonTest>(type, description, setup, std::move(object));
  };
  library.define(std::move(factory));
}

void define_optimizer(Library& library, const py::dict& declared) {
  OptimizerFactory factory;
  fill_in(factory, declared);
  Optimizer::Needs needs;
  const py::dict said = declared["needs"];
  const auto needed = [&said](const char* what) { return said[what].cast<bool>(); };
  needs.residuals = needed("residuals");
  needs.gradient = needed("gradient");
  needs.constraints = needed("constraints");
  needs.batch = needed("batch");
  needs.random = needed("random");
  needs.infeasible = needed("infeasible");
  factory.create = [type = factory.type, needs,
                    maker = Kept(declared["make"])](const Options& options) -> std::unique_ptr<Optimizer> {
    return std::make_unique<PythonOptimizer>(type, needs, made(maker, type, options));
  };
  library.define(std::move(factory));
}

void define_mechanism(Library& library, const py::dict& declared) {
  MechanismFactory factory;
  factory.id = declared["name"].cast<std::string>();
  factory.cause = declared["doc"].cast<std::string>();
  factory.reference = declared["reference"].cast<std::string>();
  factory.parameters = parameters_from(declared["parameters"], owner_of(factory.id));
  if (factory.parameters.empty())
    throw InputError(owner_of(factory.id) + ": a mechanism has no parameter; give its amplitude first");
  factory.options = options_from(declared["options"], owner_of(factory.id));
  factory.null = declared["null"].cast<double>();
  const auto side = declared["side"].cast<std::string>();
  factory.side = side == "both"   ? MechanismFactory::Side::both
                 : side == "even" ? MechanismFactory::Side::even
                                  : MechanismFactory::Side::positive;
  std::tie(factory.plausible_min, factory.plausible_max) = declared["plausible"].cast<std::pair<double, double>>();
  factory.applies_to = declared["applies_to"].cast<std::vector<std::string>>();
  factory.look_alikes = declared["look_alikes"].cast<std::vector<std::string>>();
  factory.isolated_by = declared["isolated_by"].cast<std::string>();
  factory.directional = declared["directional"].cast<bool>();
  const Kept maker(declared["make"]);
  if (declared["of_material"].cast<bool>()) {
    factory.stage = Stage::energy;
    factory.wrap_model = [description = model_description(declared, factory.id), null = factory.null, maker](
                             std::unique_ptr<Model> base, const Options& options) -> std::unique_ptr<Model> {
      return std::make_unique<AddedPythonEnergy>(std::move(base), make_model(maker, description, options), null);
    };
  } else {
    factory.stage = Stage::data;
    MechanismFactory bare = factory;  // without functions
    factory.wrap_test = [bare, maker](std::unique_ptr<Test> base, const Options& options) -> std::unique_ptr<Test> {
      auto object = guarded_making(owner_of(bare.id), [&] {
        std::vector<std::string> abscissae;
        for (const auto& column : base->rows().abscissae) abscissae.push_back(column.observable);
        const py::dict rows(py::arg("abscissae") = abscissae, py::arg("channels") = base->rows().channels,
                            py::arg("count") = base->rows().count, py::arg("stress_measure") = "",
                            py::arg("time") = std::vector<double>(base->rows().time.begin(), base->rows().time.end()));
        // The options of the test come along; the mechanism takes those that it declares.
        const py::dict given = keywords_of(options);
        py::dict own;
        for (const Option& option : bare.options)
          if (given.contains(option.name.c_str())) own[option.name.c_str()] = given[option.name.c_str()];
        return Kept(maker.get()(rows, **own));
      });
      return std::make_unique<PythonReadings>(bare, std::move(base), std::move(object));
    };
  }
  library.define(std::move(factory));
}

void add_search(py::module_& module) {
  using Search = SearchOfOptimizer;
  py::class_<Search, std::shared_ptr<Search>>(module, "Search")
      .def_property_readonly("dimension", [](const Search& self) { return self.get().dimension(); })
      .def_property_readonly("start", [](const Search& self) { return array_of(self.get().start()); })
      .def_property_readonly(
          "blocks",
          [](const Search& self) {
            py::list all;
            for (const auto& block : self.get().blocks())
              all.append(py::dict(
                  py::arg("offset") = block.offset, py::arg("size") = block.size, py::arg("weight") = block.weight,
                  py::arg("loss") = block.loss == ResidualBlock::Loss::quadratic ? "quadratic" : "root"));
            return all;
          })
      .def_property_readonly("constraint_count", [](const Search& self) { return self.get().constraint_count(); })
      .def_property_readonly("should_stop", [](const Search& self) { return self.get().should_stop(); })
      .def_property_readonly("evaluations", [](const Search& self) { return self.get().evaluations(); })
      .def_property_readonly("budget", [](const Search& self) { return self.get().budget(); })
      .def("seed", [](const Search& self, const std::string& purpose) { return self.get().seed(purpose); })
      .def("evaluate", &Search::evaluate)
      .def("evaluate_batch", &Search::evaluate_batch)
      .def("linearise", &Search::linearise)
      .def("constraints", &Search::constraints)
      .def("for_each_start", &Search::for_each_start);
}

}  // namespace

void add_definitions(py::module_& module) {
  add_search(module);
  module.def("define_model", &define_model);
  module.def("define_test", &define_test);
  module.def("define_optimizer", &define_optimizer);
  module.def("define_mechanism", &define_mechanism);
}

}  // namespace tunica::python
