// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "shifted.hpp"
#include "tunica/plugin.hpp"

namespace tunica::controlled_strip {

/// What both tests share: a strip along an axis, made from options and channels. Times, where there are any, may not
/// run backwards.
Strip strip_of(const TestSetup& setup, const char* type);
/// The measure that data state; the control of a stress in it.
Control measure_of(const std::string& stress_measure);
/// Refuses more steps than a simulation can have: 10 million.
void check_steps(const char* type, double count);
/// The option "direction".
Option direction_option();
/// The measured stretches across and through the strip.
std::vector<Observable> lateral_channels();
/// The options that both share, appended: the permanent set, and the temperature with its shift.
void add_common_options(std::vector<Option>& options);
/// Every parameter that they bring.
std::vector<Parameter> all_parameters();
/// Diagnostics, parameters and promises of both.
TestDescription description_of_strip(const Strip& strip, const Temperature& temperature);

TestFactory creep_factory();
TestFactory loading_segments_factory();

}  // namespace tunica::controlled_strip
