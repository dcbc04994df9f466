// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "../mechanisms/shelf.hpp"
#include "support/loaded.hpp"

/// Strips whose load is prescribed, and the materials that they carry in the tests here.
namespace tunica::testing {

struct CreepSetup {
  std::vector<std::string> channels = {"stretch"};
  std::string measure = "cauchy";
  std::string direction = "circumferential";
  std::int64_t steps = 1;
  bool permanent_set = false;
  std::string shift = "none";
  double temperature = 0, reference = 0;
};

inline void set_temperature(TestSetup& setup, const std::string& shift, double temperature, double reference) {
  setup.options.set("shift", shift);
  setup.options.set("temperature", temperature);
  setup.options.set("reference_temperature", reference);
}

inline std::unique_ptr<Test> make_creep(const std::vector<double>& stress, const std::vector<double>& time,
                                        const CreepSetup& creep = {}) {
  TestSetup setup;
  setup.options.set("direction", creep.direction);
  setup.options.set("steps", creep.steps);
  setup.options.set("permanent_set", creep.permanent_set);
  set_temperature(setup, creep.shift, creep.temperature, creep.reference);
  setup.rows.count = stress.size();
  setup.rows.abscissae = {{"stress", stress}};
  setup.rows.channels = creep.channels;
  setup.rows.time = time;
  setup.stress_measure = creep.measure;
  return plugins::create(catalogue().tests().at("creep"), setup);
}

inline std::unique_ptr<Test> make_segments(const std::string& segments, const std::vector<double>& time,
                                           std::vector<std::string> channels, std::int64_t steps = 20,
                                           const std::string& measure = "first_piola_kirchhoff",
                                           bool permanent_set = false) {
  TestSetup setup;
  setup.options.set("direction", std::string("circumferential"));
  setup.options.set("segments", segments);
  setup.options.set("steps", steps);
  setup.options.set("gauge_length", 20.0);
  setup.options.set("area", 10.0);
  setup.options.set("permanent_set", permanent_set);
  set_temperature(setup, "none", 0, 0);
  setup.rows.count = time.size();
  setup.rows.channels = std::move(channels);
  setup.rows.time = time;
  setup.stress_measure = measure;
  return plugins::create(catalogue().tests().at("loading_segments"), setup);
}

/// A base model with branches of a Prony series.
inline std::unique_ptr<Model> viscous(const std::string& base, int branches) {
  auto made = make_model(base);
  for (int k = 0; k < branches; ++k) made = wrapped("viscoelasticity", std::move(made));
  return made;
}

struct Predicted {
  Status status;
  std::vector<double> values, jacobian;
};
inline Predicted predicted(const Test& test, const Model& model, const std::vector<double>& p, bool jacobian = false,
                           const std::vector<double>& own = {}) {
  const std::size_t size = test.rows().count * test.rows().channels.size();
  Predicted out{{}, std::vector<double>(size), std::vector<double>(jacobian ? (p.size() + own.size()) * size : 0)};
  out.status = test.predict({model, p, own}, {out.values, out.jacobian, {}, {}});
  return out;
}

}  // namespace tunica::testing
