// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "conformance/test_properties.hpp"
#include "rigs/rigs.hpp"
#include "shelf.hpp"
#include "support/fe_tube.hpp"
#include "support/strip.hpp"

namespace tunica::testing {

using namespace conformance;

/// A test inside a mechanism that acts on tests, and the bare one; of a mechanism that stands for a parameter of the
/// test twice the same. The material is set S of Canales et al. 2023 (gho).
struct Subject {
  std::unique_ptr<Test> bare, with;
  std::size_t amplitude;         ///< its number among the test's parameters
  std::vector<double> bare_own;  ///< at the nulls
  std::vector<double> own;       ///< at the nulls, of `with`

  [[nodiscard]] std::vector<double> at(double value) const {
    std::vector<double> moved = own;
    moved[amplitude] = value;
    return moved;
  }
};

/// Options of a mechanism: its defaults, and these.
inline Options options_of(const std::string& mechanism, const Options& given = {}) {
  Options all = defaults(catalogue().mechanisms().at(mechanism).factory.options);
  for (const auto& [name, value] : given.values()) all.set(name, value);
  return all;
}

inline std::unique_ptr<Test> wrapped_test(const std::string& mechanism, std::unique_ptr<Test> base,
                                          const Options& given = {}) {
  return plugins::wrap(catalogue().mechanisms().at(mechanism), std::move(base), options_of(mechanism, given));
}

/// A test of a type with all channels that mechanisms look for.
inline std::unique_ptr<Test> make_test(const std::string& type, const std::string& stress_measure = "cauchy") {
  const std::vector<double> pressures{1, 8, 15, 20};
  if (type == "uniaxial")
    return make_strip({1.02, 1.1, 1.3, 1.5}, {.channels = {"transverse_stretch", "stress"}, .measure = stress_measure});
  const std::vector<std::string> channels{"outer_diameter_stretch", "inner_diameter", "axial_force"};
  Options exact;
  if (type == "thick_wall_pressurisation") {
    exact.set("gauss_points", std::int64_t{30});  // as many wherever the parameters are
    return make_tube(pressures, {.channels = channels, .options = exact});
  }
  if (type == "torsion")
    return make_rig(type,
                    {{"inner_radius", 3.71},
                     {"thickness", 2.06},
                     {"axial_stretch", 1.2},
                     {"pressure", 8.0},
                     {"gauss_points", std::int64_t{30}}},
                    {{"twist", {0.5, 1, 2, 3}}}, {"torque", "outer_diameter", "axial_force"});
  exact.set("tolerance", 1e-10);
  return make_fe_tube(pressures, {.elements = "[2, 3]", .channels = channels, .options = exact});
}

inline Subject subject(const std::string& mechanism, const std::string& type) {
  const MechanismFactory& factory = catalogue().mechanisms().at(mechanism).factory;
  Subject made{make_test(type), make_test(type), 0, {}, {}};
  made.bare_own = made.bare->describe().nulls;
  if (factory.native.empty()) {
    Options target;
    for (const Option& option : factory.options)
      if (option.name == "channel")
        target.set("channel", made.bare->rows().channels.back());
      else if (option.name == "rows")
        target.set("rows", std::string("1:3"));
    if (!factory.sizes.empty()) {  // of the strip, as a file says them
      for (const auto& [name, value] : {std::pair("length", 20.0), std::pair("width", 10.0),
                                        std::pair("gauge_length", 0.0), std::pair("angle", 0.0)})
        target.set(name, value);
      target.set("direction", StripSetup().direction);
    }
    made.with = wrapped_test(mechanism, std::move(made.with), target);
  }
  made.own = made.with->describe().nulls;
  const auto& parameters = made.with->describe().parameters;
  made.amplitude = parameters.size() - 1;
  for (std::size_t k = 0; k < parameters.size() && !factory.native.empty(); ++k)
    if (parameters[k].name == factory.native) made.amplitude = k;
  return made;
}

}  // namespace tunica::testing
