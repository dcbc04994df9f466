// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "conformance/verdict.hpp"
#include "plugins/catalogue.hpp"
#include "tunica/plugin.hpp"

/// What a plugin says about itself, from which schema, help, validation and reports are made: complete, and true of the
/// objects it makes.
namespace tunica::conformance {

Verdict declaration_is_complete(const ModelFactory& factory);
Verdict declaration_is_complete(const TestFactory& factory);
Verdict declaration_is_complete(const OptimizerFactory& factory);
Verdict declaration_is_complete(const MechanismFactory& factory, const plugins::Catalogue& catalogue);

/// Parameters as an object declares them: names, units, bounds, a sentence each.
Verdict parameters_are_declared(const std::vector<Parameter>& parameters);
/// Parameters, nulls and diagnostics of a test, against those that its type says tests can have.
Verdict parameters_are_declared(const TestDescription& description, const TestFactory& factory);

}  // namespace tunica::conformance
