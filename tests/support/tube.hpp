// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "support/loaded.hpp"

namespace tunica::testing {

/// Set S of Canales et al. 2023: mu, kappa, k1, k2, theta.
inline const std::vector<double> set_s{18.668, 0.1367, 24.905, 0.2912, 46.44};
/// Parameters of the tube at which it is the bare one, in their order.
inline const std::vector<double> bare_tube{0, 0, 0, 0, 1};
enum Imperfection : std::size_t { opening_angle, axial_stretch_error, tethering, thickness_error, layer_ratio };

struct TubeSetup {
  std::vector<std::string> channels = {"outer_diameter_stretch", "axial_force"};
  double axial_stretch = 1.2;  ///< held; ignored where `axial_stretches` is given
  std::vector<double> axial_stretches = {};
  double inner_radius = 3.71, thickness = 2.06;
  std::vector<double> time = {};
  Options options = {};  ///< beyond those above
  std::vector<double> layers = {};
};

inline std::unique_ptr<Test> make_tube(const std::vector<double>& pressure, const TubeSetup& tube = {}) {
  const auto& entry = catalogue().tests().at("thick_wall_pressurisation");
  TestSetup setup;
  setup.options = defaults(entry.factory.options);
  setup.options.set("inner_radius", tube.inner_radius);
  setup.options.set("thickness", tube.thickness);
  if (tube.axial_stretches.empty()) setup.options.set("axial_stretch", tube.axial_stretch);
  for (const auto& [name, value] : tube.options.values()) setup.options.set(name, value);
  setup.rows.count = pressure.size();
  setup.rows.abscissae = {{"pressure", pressure}};
  if (!tube.axial_stretches.empty()) setup.rows.abscissae.push_back({"axial_stretch", tube.axial_stretches});
  setup.rows.channels = tube.channels;
  setup.rows.time = tube.time;
  setup.layers = tube.layers;
  return plugins::create(entry, setup);
}

struct Inflation {
  Status status;
  std::vector<double> values, diagnostics;  ///< channel by channel, as the test writes them
};

inline Inflation inflate(const Test& test, const Model& model, const std::vector<double>& p,
                         const std::vector<double>& own = bare_tube, std::span<const Model* const> layers = {}) {
  const std::size_t n = test.rows().count;
  Inflation out;
  out.values.resize(n * test.rows().channels.size());
  out.diagnostics.resize(n * test.describe().diagnostics.size());
  out.status = test.predict({model, p, own, {}, layers}, {out.values, {}, {}, out.diagnostics});
  return out;
}

}  // namespace tunica::testing
