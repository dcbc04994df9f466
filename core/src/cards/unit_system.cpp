// SPDX-License-Identifier: Apache-2.0
#include "cards/unit_system.hpp"

#include <cmath>

#include <fmt/format.h>

#include "data/nearest.hpp"
#include "data/units.hpp"
#include "tunica/error.hpp"

namespace tunica::cards {

namespace {

constexpr const char* examples = "mm-N-MPa, m-N-Pa, mm-mN-kPa, um-nN-kPa or in-lbf-psi";

double converted(std::string_view text, double value, const std::string& from, const std::string& to) {
  try {
    return data::convert(value, from, to);
  } catch (const InputError& problem) {
    throw InputError(fmt::format("units '{}': {}; expected length-force-stress, for example {}", data::excerpt(text),
                                 problem.what(), examples));
  }
}

}  // namespace

UnitSystem unit_system(std::string_view text) {
  const auto first = text.find('-'), second = text.find('-', first + 1);
  if (first == 0 || second == std::string_view::npos || second == first + 1 || second + 1 == text.size() ||
      text.find('-', second + 1) != std::string_view::npos)
    throw InputError(fmt::format("units: found '{}', expected length-force-stress; give for example {}",
                                 data::excerpt(text), examples));
  UnitSystem system{std::string(text.substr(0, first)), std::string(text.substr(first + 1, second - first - 1)),
                    std::string(text.substr(second + 1))};
  const double square = std::pow(converted(text, 1, system.length, "m"), 2);
  const double stress = converted(text, 1, system.force, "N") / square / converted(text, 1, system.stress, "Pa");
  if (!(std::abs(stress - 1) < 1e-6))
    throw InputError(
        fmt::format("units '{}': {} over the square of {} is {:.6g} {}, so they are not consistent; give for example "
                    "{}",
                    data::excerpt(text), system.force, system.length, stress, system.stress, examples));
  system.stress_per_kPa = converted(text, 1, "kPa", system.stress);
  return system;
}

}  // namespace tunica::cards
