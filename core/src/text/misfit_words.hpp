// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Words on the size of a misfit: runs, diagnoses and reports judge it in the same ones.
namespace tunica::text {

/// "6.9 %", "0.24 %"
std::string percent(double share);

/// "misses by 6.9 % of the range"
std::string misses_by(double rms);

/// "tolerance 2.0 % (stated): nearly reached". It is reached where the upper bound of the misfit is below it.
std::string against_tolerance(double rms, double upper, double tolerance, std::string_view origin);

}  // namespace tunica::text
