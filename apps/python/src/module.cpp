// SPDX-License-Identifier: Apache-2.0
#include "module.hpp"

#include "comparison/provenance.hpp"
#include "diagnosis/evidence/base_fit.hpp"
#include "execution/files.hpp"
#include "plugins/guarded.hpp"
#include "text/escaped.hpp"
#include "tunica/error.hpp"

namespace tunica::python {

namespace {

/// Exceptions of the core become those of the package, whose classes stand in tunica/errors.py.
// NOLINTNEXTLINE(performance-unnecessary-value-param): as pybind11 calls it
void translate(std::exception_ptr thrown) {
  const auto raise = [](const char* name, const char* message) {
    const auto type = py::module_::import("tunica.errors").attr(name);
    PyErr_SetString(type.ptr(), text::message(message).c_str());  // bytes that are not UTF-8 would raise another
  };
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& problem) {
    raise("InputError", problem.what());
  } catch (const plugins::PluginFailure& problem) {
    raise("PluginFailure", problem.what());
  } catch (const diagnosis::BaseFitFailure& problem) {
    raise("EvaluationError", problem.what());
  } catch (const execution::WriteFailure& problem) {
    raise("WriteFailure", problem.what());
  }
}

}  // namespace

}  // namespace tunica::python

PYBIND11_MODULE(_core, module) {
  using namespace tunica::python;
  module.doc() = "What the package tunica calls; use the package.";
  module.attr("version") = tunica::comparison::version();
  py::register_exception_translator(&translate);
  add_library(module);
  add_verbs(module);
  add_studies(module);
  add_problem(module);
  add_material(module);
  add_definitions(module);
}
