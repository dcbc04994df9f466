// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cards/material.hpp"
#include "support/loaded.hpp"

namespace tunica::testing {

/// A model of the plugins with values by the names of its parameters.
struct Given {
  std::string type;
  std::map<std::string, double> values = {};
  Options options = {};  ///< what differs from the defaults
};

inline Options all_options(const Given& given) {
  Options all = defaults(catalogue().models().at(given.type).factory.options);
  for (const auto& [name, value] : given.options.values()) all.set(name, value);
  return all;
}

/// In the order of the model's description.
inline std::vector<double> values_of(const Given& given) {
  const auto model = make_model(given.type, given.options);
  std::vector<double> values;
  for (const Parameter& parameter : model->describe().parameters) values.push_back(given.values.at(parameter.name));
  return values;
}

inline cards::Material material(const Given& given) {
  return cards::material_of(catalogue(), {given.type, all_options(given)}, {}, values_of(given));
}

inline Options option(const std::string& name, const Option::Value& value) {
  Options options;
  options.set(name, value);
  return options;
}

}  // namespace tunica::testing
