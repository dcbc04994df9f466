// SPDX-License-Identifier: Apache-2.0
#include "settings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tunica/error.hpp"

namespace tunica::plane {
namespace {

constexpr std::size_t most_elements = 40000;

double positive(const Options& given, const char* name) {
  const double value = given.number(name);
  if (!(value > 0))
    throw InputError(
        fmt::format("plane_specimen: \"{}\" is {:g} mm; give a length above 0, for example \"20 mm\"", name, value));
  return value;
}

}  // namespace

Shape shape_of(const Options& given) {
  Shape shape;
  const std::string& kind = given.text("shape");
  shape.kind = kind == "dog_bone"          ? Shape::Kind::dog_bone
               : kind == "plate_with_hole" ? Shape::Kind::with_a_hole
                                           : Shape::Kind::strip;
  shape.length = positive(given, "length");
  shape.width = positive(given, "width");
  const auto refuse = [&](const char* name, bool used) {
    if (!used && given.number(name) != 0)
      throw InputError(fmt::format(
          "plane_specimen: \"{}\" is given, and the shape is '{}', which has none; leave it out", name, kind));
  };
  const bool bone = shape.kind == Shape::Kind::dog_bone, plate = shape.kind == Shape::Kind::with_a_hole;
  for (const char* name : {"gauge_section", "gauge_width", "fillet"}) refuse(name, bone);
  refuse("hole_radius", plate);
  if (bone) {
    shape.gauge_section = positive(given, "gauge_section");
    shape.gauge_width = positive(given, "gauge_width");
    shape.fillet = positive(given, "fillet");
    const double rise = (shape.width - shape.gauge_width) / 2;
    if (!(rise > 0))
      throw InputError(fmt::format(
          "plane_specimen: \"gauge_width\" is {:g} mm, and \"width\" at the grips {:g} mm; give a gauge width below it",
          shape.gauge_width, shape.width));
    if (shape.fillet < rise)
      throw InputError(
          fmt::format("plane_specimen: arcs of \"fillet\" {:g} mm do not rise from {:g} to {:g} mm; give a radius of "
                      "{:g} mm or more",
                      shape.fillet, shape.gauge_width, shape.width, rise));
    const double needed = shape.gauge_section + 2 * std::sqrt(rise * (2 * shape.fillet - rise));
    if (needed > shape.length * (1 + 1e-9))
      throw InputError(
          fmt::format("plane_specimen: \"gauge_section\" and arcs of \"fillet\" {:g} mm take {:g} mm, and \"length\" "
                      "between the grips "
                      "is {:g} mm; give a shorter gauge section, a smaller fillet or a larger length",
                      shape.fillet, needed, shape.length));
  }
  if (plate) {
    shape.hole = positive(given, "hole_radius");
    if (2 * shape.hole >= std::min(shape.width, shape.length))
      throw InputError(fmt::format(
          "plane_specimen: a hole of radius {:g} mm does not fit into {:g} × {:g} mm; give a smaller \"hole_radius\"",
          shape.hole, shape.length, shape.width));
  }
  return shape;
}

std::array<std::size_t, 2> elements_of(const std::string& text, const Shape& shape) {
  const nlohmann::json given = nlohmann::json::parse(text, nullptr, false);
  if (given.is_null()) {
    if (shape.kind == Shape::Kind::with_a_hole) return {16, 10};
    const double aspect = std::clamp(shape.length / shape.width, 0.5, 6.0);
    return {static_cast<std::size_t>(2 * std::lround(6 * aspect)), 12};
  }
  const bool pair = given.is_array() && given.size() == 2 && given[0].is_number_unsigned() &&
                    given[1].is_number_unsigned() && given[0] >= 2 && given[1] >= 2;
  if (!pair || given[0] > most_elements || given[1] > most_elements ||
      static_cast<std::size_t>(given[0]) * static_cast<std::size_t>(given[1]) > most_elements)
    throw InputError(
        fmt::format("plane_specimen: \"elements\" is {}; give two numbers from 2 on, [along, across], for "
                    "example [24, 12]; at most {} in all",
                    text, most_elements));
  return {given[0], given[1]};
}

}  // namespace tunica::plane
