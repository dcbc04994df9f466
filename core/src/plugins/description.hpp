// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "plugins/catalogue.hpp"

namespace tunica::plugins {

/// Options with their defaults; where the user must give one, the first that is allowed, since the object is made
/// only to be asked what it is.
Options any_options(const std::vector<Option>& options);

/// Parameters of a test: its own, each with the value at which it does nothing, NaN where there is none.
struct TestParameters {
  std::vector<Parameter> parameters;
  std::vector<double> nulls;
};
TestParameters parameters_of(const Catalogue::Entry<TestFactory>& entry);

/// What `describe --json` prints of one object.
nlohmann::ordered_json description_json(const Catalogue::Entry<ModelFactory>& entry);
nlohmann::ordered_json description_json(const Catalogue::Entry<TestFactory>& entry);
nlohmann::ordered_json description_json(const Catalogue::Entry<OptimizerFactory>& entry);
nlohmann::ordered_json description_json(const Catalogue::Entry<MechanismFactory>& entry);

}  // namespace tunica::plugins
