// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rest_length.hpp"
#include "strip_point.hpp"

namespace tunica::controlled_strip {

/// The prescribed quantity along the strip: its stretch, or a stress in one of three measures.
enum class Control { stretch, cauchy, nominal, second };

/// σ is divided by λ1 to this power to give the prescribed stress.
constexpr int power(Control control) { return control == Control::nominal ? 1 : control == Control::second ? 2 : 0; }

/// Where the material is: l = ln λ1, y = ln λ2², as it feels them.
struct Place {
  double l = 0, y = 0;
};

/// The prescribed quantity at a place, with its slopes, from what the point bears there. Of a stretch it is the one
/// that is felt; a stress other than Cauchy's refers to the section before the set.
Slope controlled(Control control, const StripPoint& point, const RestLength& rest, Place at);

/// Finds the place where the controlled quantity has this value and the lateral faces are free, `time_step` after the
/// accepted past, from where the strip was. Newton's method in (l, y), damped; where it does not settle, the value is
/// approached in parts, from the one before, at the same past. On success the point holds the response there.
bool find_equilibrium(StripPoint& point, const RestLength& rest, Control control, double value, double time_step,
                      Place& at, bool by_parameters);

}  // namespace tunica::controlled_strip
