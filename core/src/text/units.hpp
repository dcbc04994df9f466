// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Units beside numbers and names. Quantities without a dimension have the unit "1", or "", and show none.
namespace tunica::text {

bool is_dimensionless(std::string_view unit);

/// " kPa", to stand after a number; "" without a dimension.
std::string unit_suffix(std::string_view unit);

/// "mu [kPa]"; the name alone without a dimension.
std::string titled(std::string_view name, std::string_view unit);

}  // namespace tunica::text
