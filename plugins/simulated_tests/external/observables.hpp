// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tunica/test.hpp"

namespace tunica::external {

/// The columns of data that a simulation outside of tunica can be compared with: what is prescribed, and what is
/// measured, for any kind of experiment.
inline std::vector<Observable> observables() {
  using Role = Observable::Role;
  using Kind = Observable::Kind;
  std::vector<Observable> all = {
      {"stretch", "1", Role::abscissa, false, "Prescribed stretch.", Kind::stretch},
      {"displacement", "mm", Role::abscissa, false, "Prescribed displacement.", Kind::plain},
      {"pressure", "kPa", Role::abscissa, false, "Prescribed pressure.", Kind::plain},
      {"load", "mN", Role::abscissa, false, "Prescribed force.", Kind::plain},
      {"rotation", "deg", Role::abscissa, false, "Prescribed angle.", Kind::plain},
      {"x", "mm", Role::abscissa, false, "Position of a point, as the solver counts it.", Kind::plain},
      {"y", "mm", Role::abscissa, false, "Position of a point, as the solver counts it.", Kind::plain},
      {"z", "mm", Role::abscissa, false, "Position of a point, as the solver counts it.", Kind::plain},
      {"time", "s", Role::time, false, "Time since the unloaded state.", Kind::plain},
      {"force", "mN", Role::channel, false, "Measured force.", Kind::plain},
      {"stress", "kPa", Role::channel, false, "Measured stress, in the measure of the data.", Kind::stress},
      {"moment", "mN mm", Role::channel, false, "Measured moment.", Kind::plain},
      {"measured_pressure", "kPa", Role::channel, false, "Measured pressure.", Kind::plain},
      {"diameter", "mm", Role::channel, false, "Measured diameter.", Kind::plain},
      {"length", "mm", Role::channel, false, "Measured length, displacement or thickness.", Kind::plain},
      {"measured_stretch", "1", Role::channel, false, "Measured stretch.", Kind::stretch},
      {"value", "1", Role::channel, false, "Any other measured number.", Kind::plain},
      {"second_value", "1", Role::channel, false, "Any other measured number.", Kind::plain},
      {"third_value", "1", Role::channel, false, "Any other measured number.", Kind::plain}};
  const auto components = [&all](const char* quantity, const char* unit, const std::vector<const char*>& axes,
                                 const char* doc) {
    for (const char* const axis : axes)
      all.push_back({std::string(quantity) + '_' + axis, unit, Role::channel, false, doc, Kind::plain});
  };
  components("displacement", "mm", {"x", "y", "z"}, "Measured component of a displacement, of one point or of many.");
  components("force", "mN", {"x", "y", "z"}, "Measured component of a force.");
  components("moment", "mN mm", {"x", "y", "z"}, "Measured component of a moment.");
  components("strain", "1", {"xx", "yy", "zz", "xy", "yz", "xz"}, "Measured component of a strain.");
  return all;
}

}  // namespace tunica::external
