// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "follow.hpp"
#include "tunica/plugin.hpp"

namespace tunica::controlled_strip {

/// What both tests share: a strip along an axis, made from options and channels. Times, where there are any, may not
/// run backwards.
Strip strip_of(const TestSetup& setup, const char* type);
/// The measure that data state; the control of a stress in it.
Control measure_of(const std::string& stress_measure);
/// The option "direction".
Option direction_option();
/// The measured stretches across and through the strip.
std::vector<Observable> lateral_channels();
/// The flag of the permanent set, and the parameter that it brings.
Option set_option();
std::vector<Parameter> set_parameter();
/// Diagnostics, parameters and promises of both.
TestDescription description_of_strip(const Strip& strip);

TestFactory creep_factory();
TestFactory loading_segments_factory();

}  // namespace tunica::controlled_strip
