// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

/// The parts of the extension module tunica._core. It converts and calls; what is computed, the core computes. The
/// package around it (apps/python/tunica) is what users see.
namespace tunica::python {

namespace py = pybind11;

void add_library(py::module_& module);      ///< plugins, experiments, what there is
void add_verbs(py::module_& module);        ///< run, check, simulate, diagnose, certify
void add_studies(py::module_& module);      ///< cohort, stability, pages of several folders
void add_problem(py::module_& module);      ///< residuals and derivatives of one run
void add_material(py::module_& module);     ///< a model at given deformations
void add_definitions(py::module_& module);  ///< models, tests, optimisers and mechanisms written in Python

}  // namespace tunica::python
