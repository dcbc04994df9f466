// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tunica::data {

/// Base units: kPa, mm, mN, s, deg, 1. Conversions are by UDUNITS-2; thread-safe.
/// Throws InputError on an unknown unit (nearest known one named) or incompatible dimensions (both named).
double convert(double value, std::string_view from, std::string_view to);
bool is_unit(std::string_view unit);

/// The unit at the end of the name of a column, "N" of "Force_N" and of "Kraft/N", where it is a usual one that
/// converts to the base unit; else empty.
std::string unit_in_name(const std::string& name, std::string_view base);

/// "3.71 mm" → 3.71 in `base_unit`; a bare number is in the base unit. Throws InputError.
double parse_quantity(std::string_view text, std::string_view base_unit);

}  // namespace tunica::data
