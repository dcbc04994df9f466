// SPDX-License-Identifier: Apache-2.0
// A sheet under a camera: points of a grid that a function moves, and the test of them.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "data/units.hpp"
#include "plugins/guarded.hpp"
#include "support/loaded.hpp"

namespace tunica::testing::full_field {

using Point = std::array<double, 2>;

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Points of steps with their displacements, then one row of forces a step.
struct Measured {
  std::vector<double> step, x, y, ux, uy;
  std::vector<std::string> channels = {"ux", "uy", "force_left", "force_right", "force_bottom", "force_top"};
  [[nodiscard]] std::size_t points() const { return static_cast<std::size_t>(std::count(x.begin(), x.end(), x[0])); }
};

struct Plate {
  std::string mesh = R"({"size": 2})", shape = R"({"rectangle": [10, 6], "corner": [-3, 1]})",
              boundary = R"({"left": "measured", "right": "measured", "bottom": "measured", "top": "measured"})",
              state = "plane_stress";
  std::string unseen = "refuse";
  double angle = 0;
  std::int64_t smoothing = 2;
  std::string method = "finite_elements";
};

/// `field` gives the displacement of a point at a load from 0 to 1.
template <class Field>
Measured measure(const std::vector<double>& loads, const Field& field, const Point& low, const Point& high,
                 std::size_t count = 13) {
  Measured all;
  for (const double load : loads)
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j) {
        const auto place = [&](std::size_t axis, std::size_t k) {
          return low[axis] + (high[axis] - low[axis]) * static_cast<double>(k) / static_cast<double>(count - 1);
        };
        const Point at{place(0, i), place(1, j)}, u = field(at, load);
        all.step.push_back(load);
        all.x.push_back(at[0]);
        all.y.push_back(at[1]);
        all.ux.push_back(u[0]);
        all.uy.push_back(u[1]);
      }
  for (const double load : loads) {
    all.step.push_back(load);
    for (auto* column : {&all.x, &all.y, &all.ux, &all.uy}) column->push_back(nan);
  }
  return all;
}

inline std::unique_ptr<Test> make(const Plate& of, const Measured& measured) {
  TestSetup setup;
  for (const auto& [name, value] : {std::pair("mesh", of.mesh), std::pair("shape", of.shape),
                                    std::pair("boundary", of.boundary), std::pair("state", of.state)})
    setup.options.set(name, value);
  setup.options.set("unseen_sides", of.unseen);
  setup.options.set("thickness", 2.0);
  setup.options.set("material_angle", of.angle);
  setup.options.set("smoothing", of.smoothing);
  setup.options.set("method", of.method);
  setup.rows.count = measured.step.size();
  setup.rows.abscissae = {{"step", measured.step}, {"x", measured.x}, {"y", measured.y}};
  setup.rows.channels = measured.channels;
  const std::vector<double> nothing(measured.step.size(), nan);
  for (const std::string& channel : measured.channels)
    setup.measured.emplace_back(channel == "ux" ? measured.ux : channel == "uy" ? measured.uy : nothing);
  setup.unit_factor = [](std::string_view from, std::string_view to) { return data::convert(1, from, to); };
  return plugins::create(catalogue().tests().at("full_field"), setup);
}

}  // namespace tunica::testing::full_field
