// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <fmt/format.h>

#include "data/units.hpp"
#include "properties.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

const std::vector<std::pair<std::string, std::vector<std::string>>> dimensions{
    {"kPa", {"Pa", "kPa", "MPa", "mmHg", "N/mm2", "bar", "psi", "mN/mm2"}},
    {"mm", {"m", "mm", "um", "cm", "inch"}},
    {"mN", {"N", "mN", "kN", "gf", "uN"}},
    {"s", {"s", "ms", "min", "hour"}},
    {"deg", {"deg", "rad"}},
    {"1", {"1", "%"}}};

bool close(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); }

RC_GTEST_PROP(Units, AConversionHasAWayBackAndManyWaysThere, ()) {
  const auto& [base, units] = *rc::gen::elementOf(dimensions);
  const std::string from = *rc::gen::elementOf(units), over = *rc::gen::elementOf(units),
                    to = *rc::gen::elementOf(units);
  const double value = *properties::number();
  const double there = convert(value, from, to);
  RC_ASSERT(close(convert(there, to, from), value));
  RC_ASSERT(close(convert(convert(value, from, over), over, to), there));
  RC_ASSERT(close(convert(-3 * value, from, to), -3 * there));
  RC_ASSERT(convert(value, from, from) == value);
}

RC_GTEST_PROP(Units, AQuantityIsItsNumberConverted, ()) {
  const auto& [base, units] = *rc::gen::elementOf(dimensions);
  const std::string unit = *rc::gen::elementOf(units);
  const double value = *properties::number();
  if (unit != "1") {  // which is written without a unit
    RC_ASSERT(parse_quantity(fmt::format("{} {}", value, unit), base) == convert(value, unit, base));
  }
  RC_ASSERT(parse_quantity(fmt::format("{}", value), base) == value);
}

RC_GTEST_PROP(Units, OfOtherDimensionsAreRefused, ()) {
  const auto& one = *rc::gen::elementOf(dimensions);
  const auto& other = *rc::gen::elementOf(dimensions);
  // The radian is a number to UDUNITS-2.
  RC_PRE(one.first != other.first && one.first != "deg" && other.first != "deg");
  RC_ASSERT_THROWS_AS(convert(1, *rc::gen::elementOf(one.second), *rc::gen::elementOf(other.second)), InputError);
}

}  // namespace
}  // namespace tunica::data
