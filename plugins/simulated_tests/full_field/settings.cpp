// SPDX-License-Identifier: Apache-2.0
#include "settings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tunica/error.hpp"

namespace tunica::field {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(const char* option, const std::string& what, const char* help) {
  throw InputError(fmt::format("full_field: \"{}\": {}; {}", option, what, help));
}

/// "20 mm" or a number of mm.
double length(const TestSetup& setup, const Json& json, const char* option) {
  if (json.is_number()) return json.get<double>();
  const char* const help = R"(give a length such as "20 mm")";
  if (!json.is_string()) refuse(option, fmt::format("{} is no length", json.dump()), help);
  const auto& text = json.get_ref<const std::string&>();
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string unit(text.find_first_not_of(' ', static_cast<std::size_t>(end - text.data())) == std::string::npos
                             ? ""
                             : text.substr(text.find_first_not_of(' ', static_cast<std::size_t>(end - text.data()))));
  if (error != std::errc() || unit.empty()) refuse(option, fmt::format("'{}' is no length with a unit", text), help);
  return value * (setup.unit_factor ? setup.unit_factor(unit, "mm") : 1.0);
}

void allow_only(const Json& json, std::initializer_list<const char*> keys, const char* option) {
  for (const auto& [key, value] : json.items())
    if (std::none_of(keys.begin(), keys.end(), [&key](const char* one) { return key == one; }))
      refuse(option, fmt::format("the key '{}' is unknown", key),
             fmt::format("known: {}", fmt::join(keys, ", ")).c_str());
}

Vector pair(const TestSetup& setup, const Json& json, const char* option) {
  if (!json.is_array() || json.size() != 2)
    refuse(option, fmt::format("{} is no pair of lengths", json.dump()), R"(give [x, y] such as ["20 mm", "10 mm"])");
  return {length(setup, json[0], option), length(setup, json[1], option)};
}

Outline outline_of(const TestSetup& setup) {
  const Json given = Json::parse(setup.options.text("shape"), nullptr, false);
  constexpr const char* help =
      R"(give {"rectangle": ["20 mm", "20 mm"], "holes": [{"centre": [0, 0], "radius": "3 mm"}]})";
  if (!given.is_object() || !given.contains("rectangle")) refuse("shape", "a rectangle is missing", help);
  allow_only(given, {"rectangle", "corner", "holes"}, "shape");
  Outline outline;
  outline.size = pair(setup, given["rectangle"], "shape");
  if (!(outline.size[0] > 0 && outline.size[1] > 0)) refuse("shape", "a side of the rectangle is not positive", help);
  if (given.contains("corner")) outline.corner = pair(setup, given["corner"], "shape");
  const Json holes = given.value("holes", Json::array());
  if (!holes.is_array()) refuse("shape", "\"holes\" is no list", help);
  for (const Json& hole : holes) {
    if (!hole.is_object() || !hole.contains("centre") || !hole.contains("radius"))
      refuse("shape", "a hole has no \"centre\" or no \"radius\"", help);
    allow_only(hole, {"centre", "radius"}, "shape");
    const double radius = length(setup, hole["radius"], "shape");
    if (!(radius > 0)) refuse("shape", "the radius of a hole is not positive", help);
    outline.holes.push_back({pair(setup, hole["centre"], "shape"), radius});
  }
  return outline;
}

}  // namespace

Mesh mesh_of(const TestSetup& setup) {
  const Json given = Json::parse(setup.options.text("mesh"), nullptr, false);
  const bool has_shape = setup.options.text("shape") != "null";
  constexpr const char* help = R"(give {"file": "plate.msh", "unit": "mm"}, or {"size": "0.7 mm"} beside a "shape")";
  if (!given.is_object()) refuse("mesh", "it is no object", help);
  allow_only(given, {"file", "unit", "size"}, "mesh");
  for (const char* key : {"file", "unit"})
    if (given.contains(key) && !given[key].is_string())
      refuse("mesh", fmt::format("the {} {} is no text", key, given[key].dump()), help);
  if (given.contains("file") == given.contains("size")) refuse("mesh", "one of \"file\" and \"size\" is needed", help);
  if (given.contains("file")) {
    if (has_shape) refuse("shape", "it is given beside a mesh file", "leave one of the two out");
    const std::string unit = given.value("unit", std::string("mm"));
    const auto file = std::filesystem::path(setup.folder) / given.value("file", std::string());
    return mesh_from_file(file.lexically_normal().string(), setup.unit_factor ? setup.unit_factor(unit, "mm") : 1.0);
  }
  if (!has_shape) refuse("shape", "it is missing, and \"mesh\" gives a size", help);
  const Outline outline = outline_of(setup);
  const double size = length(setup, given["size"], "mesh");
  const double cells = outline.size[0] * outline.size[1] / (size * size);
  if (!(size > 0) || cells > 2e5)
    refuse("mesh", fmt::format("a size of {:g} mm makes {:.3g} triangles", size, 2 * cells), "give a larger one");
  return mesh_of(outline, size);
}

Edges edges_of(const Options& given) {
  const Json json = Json::parse(given.text("boundary"), nullptr, false);
  constexpr const char* help =
      R"(give sides such as {"left": {"x": "fixed"}, "right": "measured"}; words are free, fixed, uniform, measured)";
  if (!json.is_object()) refuse("boundary", "it is no object", help);
  allow_only(json, {"left", "right", "bottom", "top"}, "boundary");
  const auto edge = [&](const Json& word) {
    if (word == "free") return Edge::free;
    if (word == "fixed") return Edge::fixed;
    if (word == "uniform") return Edge::uniform;
    if (word == "measured") return Edge::measured;
    refuse("boundary", fmt::format("{} is no condition", word.dump()), help);
  };
  Edges edges{};
  bool moved = false;
  std::array<bool, 2> stopped{};
  for (std::size_t side = 0; side < 4; ++side) {
    if (!json.contains(side_names[side])) continue;
    const Json& of_side = json[side_names[side]];
    if (of_side.is_object()) allow_only(of_side, {"x", "y"}, "boundary");
    for (std::size_t c = 0; c < 2; ++c) {
      edges[side][c] = edge(of_side.is_object() ? of_side.value(c == 0 ? "x" : "y", Json("free")) : of_side);
      moved = moved || edges[side][c] == Edge::uniform || edges[side][c] == Edge::measured;
      stopped[c] = stopped[c] || edges[side][c] != Edge::free;
    }
  }
  if (!moved) refuse("boundary", "no side is uniform or measured, so that nothing would move", help);
  if (!stopped[0] || !stopped[1])
    refuse("boundary", fmt::format("nothing holds the specimen in {}", stopped[0] ? "y" : "x"), help);
  return edges;
}

}  // namespace tunica::field
