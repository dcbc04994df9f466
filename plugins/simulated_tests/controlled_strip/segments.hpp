// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "equilibrium.hpp"

namespace tunica::controlled_strip {

/// One piece of a loading: a ramp of a quantity to a value, in a straight line over time, or a hold of the one before.
struct Segment {
  Control control = Control::stretch;
  bool hold = false;
  double to = 1;              ///< end of a ramp
  double from = 0, to_t = 0;  ///< time at its beginning and its end, s
};

/// Sizes that displacements and forces need; 0 = not given.
struct Sizes {
  double gauge_length = 0, area = 0;
};

using UnitFactor = std::function<double(std::string_view from, std::string_view to)>;

/// Reads a list of segments from JSON text, for example
///
///     [ {"ramp": {"stretch": 1.5}, "duration": "2 s"}, {"hold": "100 s"},
///       {"cycle": {"nominal_stress": ["0 kPa", "50 kPa"]}, "rate": "10 kPa/s", "count": 3} ]
///
/// Quantities: stretch, displacement, nominal_stress, cauchy_stress, force. A cycle becomes two ramps for each count,
/// to its second value and back to its first. Throws InputError, which says which segment, what was found and what to
/// do.
std::vector<Segment> read_segments(const std::string& json, const Sizes& sizes, const UnitFactor& unit_factor);

}  // namespace tunica::controlled_strip
