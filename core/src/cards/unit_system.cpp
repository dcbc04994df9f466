// SPDX-License-Identifier: Apache-2.0
#include "cards/unit_system.hpp"

#include <charconv>
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
  const double length = converted(text, 1, system.length, "m"), force = converted(text, 1, system.force, "N");
  const double stress = force / (length * length) / converted(text, 1, system.stress, "Pa");
  if (!(std::abs(stress - 1) < 1e-6))
    throw InputError(
        fmt::format("units '{}': {} over the square of {} is {:.6g} {}, so they are not consistent; give for example "
                    "{}",
                    data::excerpt(text), system.force, system.length, stress, system.stress, examples));
  system.stress_per_kPa = converted(text, 1, "kPa", system.stress);
  system.density_per_kg_m3 = std::pow(length, 4) / force;
  return system;
}

double density_of(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc{} && end == text.data() + text.size())
    throw InputError(
        fmt::format("density '{0}': found a number without a unit; give for example \"1000 kg/m3\", or "
                    "\"{0} tonne/mm3\"",
                    text));
  try {
    return data::parse_quantity(text, "kg/m3");
  } catch (const InputError& problem) {
    throw InputError(fmt::format("density '{}': {}", data::excerpt(text), problem.what()));
  }
}

}  // namespace tunica::cards
