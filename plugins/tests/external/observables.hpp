// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tunica/test.hpp"

namespace tunica::external {

/// The columns of data that a simulation outside of tunica can be compared with: what is prescribed, and what is
/// measured, for any kind of experiment.
inline std::vector<Observable> observables() {
  using Role = Observable::Role;
  using Kind = Observable::Kind;
  return {{"stretch", "1", Role::abscissa, false, "Prescribed stretch.", Kind::stretch},
          {"displacement", "mm", Role::abscissa, false, "Prescribed displacement.", Kind::plain},
          {"pressure", "kPa", Role::abscissa, false, "Prescribed pressure.", Kind::plain},
          {"load", "mN", Role::abscissa, false, "Prescribed force.", Kind::plain},
          {"rotation", "deg", Role::abscissa, false, "Prescribed angle.", Kind::plain},
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
}

}  // namespace tunica::external
