// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shelf.hpp"

namespace tunica::testing {

/// A circumferential strip bound to these rows; no time = equilibrium.
inline std::unique_ptr<Test> strip(const std::vector<double>& stretch, const std::vector<std::string>& channels,
                                   const std::vector<double>& time = {}, const std::string& stress_measure = "cauchy") {
  const auto& entry = catalogue().tests().at("uniaxial");
  TestSetup setup{defaults(entry.factory.options), {}, stress_measure};
  setup.options.set("direction", std::string("circumferential"));
  setup.rows.count = stretch.size();
  setup.rows.abscissae = {{"stretch", stretch}};
  setup.rows.channels = channels;
  setup.rows.time = time;
  return plugins::create(entry, setup);
}

}  // namespace tunica::testing
