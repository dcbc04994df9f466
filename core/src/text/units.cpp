// SPDX-License-Identifier: Apache-2.0
#include "text/units.hpp"

namespace tunica::text {

bool is_dimensionless(std::string_view unit) { return unit.empty() || unit == "1"; }

std::string unit_suffix(std::string_view unit) { return is_dimensionless(unit) ? "" : std::string(" ").append(unit); }

std::string titled(std::string_view name, std::string_view unit) {
  std::string title(name);
  return is_dimensionless(unit) ? title : title.append(" [").append(unit).append("]");
}

}  // namespace tunica::text
