// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "module.hpp"
#include "tunica/plugin.hpp"

namespace tunica::python {

/// What a definition in Python declares, from the dictionaries that the package makes: their keys are the members of
/// the structs of the SDK. Throws InputError that names `owner`.
std::vector<Parameter> parameters_from(const py::list& declared, const std::string& owner);
std::vector<Option> options_from(const py::list& declared, const std::string& owner);
std::vector<Observable> observables_from(const py::list& declared, const std::string& owner);

}  // namespace tunica::python
