// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tissue.hpp"

namespace blind {

/// A long thick-walled tube held at an axial stretch and pressurised; composite Simpson rule over the reference radius,
/// the inner radius by bracketing.
struct Tube {
  double inner_radius = 0, thickness = 0;  ///< mm, as recorded
  double axial_stretch = 1;
  std::vector<double> time, pressure;  ///< s, kPa, as recorded; the axial stretch is reached at once at time 0
  std::string name = {};
};

/// What may be wrong with the tube, its surroundings and the rig, each at its null.
struct TubeFaults {
  double opening_angle = 0;                       ///< degrees, the whole missing arc
  double axial_stretch = 0;                       ///< true less recorded
  double support = 0;                             ///< kPa per outer diameter stretch gained since zero pressure
  double thickness = 0;                           ///< true = recorded (1 + this), the outer radius being right
  double layer_ratio = 1, interface = 0.5;        ///< stiffness of the inner over the outer part; where they meet
  double pressure_offset = 0, pressure_gain = 0;  ///< true = recorded (1 + gain) + offset
  double diameter_gain = 0;                       ///< true = recorded (1 + this)
  double force_offset = 0, force_gain = 0;        ///< true = recorded (1 + gain) + offset
  double slip = 0;                                ///< outside the catalogue: axial stretch lost at the largest pressure
  double pressure_bend = 0;                       ///< outside: true = recorded (1 + this · share of the largest)
  double ovality = 0;                             ///< outside: share by which the empty tube shows a wider diameter
};

/// Recorded outer diameter stretch and reduced axial force (mN) at every row; NaN from where there is no equilibrium.
struct TubeRecord {
  std::vector<double> diameter, force;
};
TubeRecord record(const Tube& tube, const Tissue& tissue, const TubeFaults& faults);

/// Simpson intervals across the wall of later calls; the default is fine enough for a hundredth of the noise.
constexpr int default_intervals = 48;
TubeRecord record(const Tube& tube, const Tissue& tissue, const TubeFaults& faults, int intervals);

/// Pressure of the bare tube at an inner radius of `widened` times the unloaded one.
double pressure_at(const Tube& tube, const Tissue& tissue, double widened);

}  // namespace blind
