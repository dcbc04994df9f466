// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "support/loaded.hpp"

namespace tunica::testing {

struct StripSetup {
  std::string direction = "circumferential";
  std::vector<std::string> channels = {"stress"};
  std::string measure = "cauchy";
  std::vector<double> time = {};
  double angle = 0;
  bool from_elongation = false;
};

inline std::unique_ptr<Test> make_strip(const std::vector<double>& stretch, const StripSetup& strip = {}) {
  TestSetup setup;
  setup.options.set("direction", strip.direction);
  setup.options.set("angle", strip.angle);
  setup.rows.count = stretch.size();
  setup.rows.abscissae = {{"stretch", stretch, strip.from_elongation}};
  setup.rows.channels = strip.channels;
  setup.rows.time = strip.time;
  setup.stress_measure = strip.measure;
  return plugins::create(catalogue().tests().at("uniaxial"), setup);
}

struct Prediction {
  Status status;
  std::vector<double> values, jacobian, abscissa_derivative, diagnostics;
};

inline Prediction predict(const Test& test, const Model& model, const std::vector<double>& p, double misalignment = 0,
                          bool derivatives = false) {
  const std::size_t n = test.rows().count, rows = n * test.rows().channels.size();
  Prediction out;
  out.values.resize(rows);
  out.diagnostics.resize(n * test.describe().diagnostics.size());
  if (derivatives) {
    out.jacobian.resize((p.size() + 1) * rows);
    out.abscissa_derivative.resize(rows);
  }
  out.status = test.predict({model, p, {&misalignment, 1}},
                            {out.values, out.jacobian, out.abscissa_derivative, out.diagnostics});
  return out;
}

inline std::vector<double> evenly(double from, double to, std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i)
    values[i] = from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
  return values;
}

}  // namespace tunica::testing
