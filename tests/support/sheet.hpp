// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "support/loaded.hpp"

namespace tunica::testing {

struct SheetSetup {
  std::vector<std::string> channels = {"stress_circumferential", "stress_axial"};
  std::string measure = "cauchy";
  std::vector<double> time = {};
  std::string direction = "circumferential";
  double angle = 0;
};
using Columns = std::vector<std::pair<std::string, std::vector<double>>>;

inline std::unique_ptr<Test> make_sheet(const std::string& protocol, const Columns& columns,
                                        const SheetSetup& sheet = {}) {
  TestSetup setup;
  setup.options.set("protocol", protocol);
  setup.options.set("direction", sheet.direction);
  setup.options.set("angle", sheet.angle);
  setup.rows.count = columns.empty() ? 0 : columns.front().second.size();
  for (const auto& [name, values] : columns) setup.rows.abscissae.push_back({name, values});
  setup.rows.channels = sheet.channels;
  setup.rows.time = sheet.time;
  setup.stress_measure = sheet.measure;
  return plugins::create(catalogue().tests().at("biaxial"), setup);
}

/// Predictions where they must succeed.
inline std::vector<double> stresses(const Test& test, const Model& model, const std::vector<double>& parameters) {
  std::vector<double> values(test.rows().count * test.rows().channels.size()),
      own(test.describe().parameters.size(), 0.0);
  const Status status = test.predict({model, parameters, own}, {values, {}, {}, {}});
  if (!status.ok()) throw std::runtime_error(status.reason());
  return values;
}

}  // namespace tunica::testing
