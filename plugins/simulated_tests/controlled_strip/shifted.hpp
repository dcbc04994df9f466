// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../temperature_shift/temperature_shift.hpp"
#include "follow.hpp"

namespace tunica::controlled_strip {

/// The temperature of a test, K: at it times are those at T0, divided by a_T.
struct Temperature {
  temperature_shift::Shift shift = temperature_shift::Shift::none;
  double T = 0, T0 = 0;
};

/// From the options; throws InputError where one is missing, or changes nothing.
Temperature temperature_of(const TestSetup& setup, const char* type);

/// follow() at this temperature. The parameters of the shift stand behind those of the strip.
Status follow_shifted(const Strip& strip, const Temperature& at, std::span<const LoadStep> steps,
                      const TestInput& input, const TestOutput& output);

}  // namespace tunica::controlled_strip
