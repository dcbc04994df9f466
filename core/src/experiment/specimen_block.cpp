// SPDX-License-Identifier: Apache-2.0
// Sizes of the unloaded specimen, and which of them what is mapped needs.
#include <algorithm>

#include <fmt/format.h>

#include "data/quantities.hpp"
#include "experiment/blocks.hpp"

namespace tunica::experiment {
namespace {

using data::Specimen;
using From = data::Quantity::Kind;

/// The sizes along a direction, "" = along all that have none of their own.
data::Sizes& sizes_at(const std::string& direction, Specimen& specimen) {
  if (direction.empty()) return specimen.all;
  for (auto& [name, sizes] : specimen.directions)
    if (name == direction) return sizes;
  return specimen.directions.emplace_back(direction, data::Sizes()).second;
}
data::Sizes written_sizes(const std::string& direction, const Specimen& specimen) {
  if (direction.empty()) return specimen.all;
  for (const auto& [name, sizes] : specimen.directions)
    if (name == direction) return sizes;
  return {};
}

double positive(const Node& node, const std::string& unit, const std::string& what) {
  const double value = node.quantity(unit, fmt::format("the {} of the specimen", what));
  if (!(value > 0))
    node.fail(fmt::format("the {} is {} {}", what, value, unit), "It must be greater than zero. Correct it.");
  return value;
}

Key<Specimen> size_key(std::string name, std::string doc, std::optional<double> Specimen::*member, std::string unit) {
  return member_key(
      name, [=] { return quantity_schema(doc); }, member, [=](const Node& node) { return positive(node, unit, name); });
}

using Size = std::optional<double> data::Sizes::*;

Key<Specimen> size_along(const std::string& direction, std::string name, std::string doc, Size member,
                         std::string what) {
  return {
      std::move(name), [=] { return quantity_schema(doc); },
      [=](const Node& node, Specimen& specimen) { sizes_at(direction, specimen).*member = positive(node, "mm", what); },
      [=](const Specimen& specimen) { return written(written_sizes(direction, specimen).*member); }};
}

/// A length, or that at the preload.
Key<Specimen> gauge_length_key(const std::string& direction, bool at_preload) {
  Key<Specimen> key =
      size_along(direction, "gauge_length", "Length at stretch 1 [mm], or \"preload\": that at the preload.",
                 &data::Sizes::gauge_length, "gauge length");
  key.schema = [schema = key.schema] {
    Json gauge = schema();
    gauge["pattern"] = "^( *[+-]?[0-9.]|preload$)";
    return gauge;
  };
  key.read = [at_preload, read = key.read](const Node& node, Specimen& specimen) {
    if (!node.is_text() || node.text("") != "preload") {
      read(node, specimen);
      return;
    }
    if (!at_preload)
      node.fail("the gauge length is that at the preload, and there is no \"preload\"",
                "Add it to the data, for example \"preload\": \"0.1 N\", or give a length.");
    specimen.gauge_at_preload = true;
  };
  key.write = [direction, write = key.write](const Specimen& specimen) {
    return direction.empty() && specimen.gauge_at_preload ? Json("preload") : write(specimen);
  };
  return key;
}

std::vector<Key<Specimen>> keys_along(const std::string& direction, bool at_preload) {
  return {size_along(direction, "width", "Width across the force [mm].", &data::Sizes::width, "width"),
          gauge_length_key(direction, at_preload),
          size_along(direction, "grip_distance",
                     "Length at displacement 0 [mm], where the gauge length is that at the preload.",
                     &data::Sizes::grip_distance, "grip distance")};
}

/// The sizes along a direction. An empty block makes an entry too: along an unmapped direction it is refused.
Key<Specimen> direction_key(const std::string& direction, bool at_preload) {
  Key<Specimen> key =
      block_key(direction, Block<Specimen>(fmt::format("the specimen along '{}'", direction),
                                           "Sizes along this direction.", keys_along(direction, at_preload))
                               .expecting("sizes along a direction, {\"width\": …, \"gauge_length\": …},"));
  key.read = [direction, read = key.read](const Node& node, Specimen& specimen) {
    sizes_at(direction, specimen);
    read(node, specimen);
  };
  return key;
}

}  // namespace

Block<Specimen> specimen_block(const std::vector<Observable>& observables, bool at_preload) {
  std::vector<Key<Specimen>> keys = {
      size_key("thickness", "Thickness [mm].", &Specimen::thickness, "mm"),
      size_key("area", "Area of the section, in place of width and thickness [mm2].", &Specimen::area, "mm2")};
  if (data::shears(observables))
    keys.push_back(size_key("height", "Distance of the plates [mm].", &Specimen::height, "mm"));
  for (Key<Specimen>& key : keys_along("", at_preload)) keys.push_back(std::move(key));
  for (const std::string& direction : data::directions_of(observables))
    keys.push_back(direction_key(direction, at_preload));
  return Block<Specimen>("the specimen", "Sizes of the unloaded specimen.", std::move(keys))
      .expecting("the sizes of the specimen, {\"width\": …, \"thickness\": …, \"gauge_length\": …},");
}

void check_specimen(const Node& node, const Specimen& specimen) {
  if (specimen.area && (specimen.thickness || node.find("width")))
    node.child_or_self("area").fail("the specimen has \"area\", and \"width\" or \"thickness\" too",
                                    "Give the area of the section, or its two sides.");
}

namespace {

/// Every size that a mapped quantity needs is there.
void require_sizes(const Node& block, std::string_view owner, const std::vector<Observable>& observables,
                   const data::DataRequest& data) {
  const Node at = block.child_or_self("specimen");
  const auto require = [&](bool given, const std::string& name, std::string_view key, std::string_view example) {
    if (!given)
      at.fail(fmt::format("'{}' of {} needs the size \"{}\" of the specimen", name, owner, key),
              fmt::format("Add it to \"specimen\", for example \"{}\": \"{}\".", key, example));
  };
  for (const auto& [name, column] : data.columns) {
    const auto quantity = data::quantity_named(name, observables);
    const data::Sizes sizes = data::sizes_along(data.specimen, quantity->observable->name);
    if (quantity->kind == From::displacement || quantity->kind == From::length)
      require(sizes.gauge_length || data.specimen.gauge_at_preload, name, "gauge_length", "12.5 mm");
    if (quantity->kind == From::displacement && data.specimen.gauge_at_preload)
      require(sizes.grip_distance.has_value(), name, "grip_distance", "12 mm");
    if (quantity->kind == From::shear_displacement) require(data.specimen.height.has_value(), name, "height", "4 mm");
    if ((quantity->kind != From::force && quantity->kind != From::plate_force) || data.specimen.area) continue;
    require(data.specimen.thickness.has_value(), name, "thickness", "1.2 mm");
    require(sizes.width.has_value(), name, "width", "10 mm");
  }
}

/// A size that no mapped quantity reads would only look as if it were used.
void refuse_idle_sizes(const Node& block, std::string_view owner, const std::vector<Observable>& observables,
                       const data::DataRequest& data) {
  const auto node = block.find("specimen");
  if (!node) return;
  bool force = false, length = false, displacement = false, plate = false;
  std::vector<std::string> directions;  // that some mapped quantity lies along
  for (const auto& [name, column] : data.columns) {
    const auto quantity = data::quantity_named(name, observables);
    force = force || quantity->kind == From::force || quantity->kind == From::plate_force;
    plate = plate || quantity->kind == From::shear_displacement;
    length = length || quantity->kind == From::displacement || quantity->kind == From::length;
    displacement = displacement || quantity->kind == From::displacement;
    if (quantity->kind != From::own) directions.push_back(data::direction_of(quantity->observable->name));
  }
  const auto refuse = [&](const Node& at, const char* key, bool read, const char* reader) {
    if (const auto size = at.find(key); size && !read)
      size->fail(
          fmt::format("\"{}\" changes nothing in {}", key, owner),
          fmt::format("It belongs to {}, and none is mapped. Map one in \"columns\", or leave the size out.", reader));
  };
  const auto look_at = [&](const Node& at, const data::Sizes& sizes) {
    refuse(at, "width", force, "a force");
    refuse(at, "thickness", force, "a force");
    refuse(at, "area", force, "a force");
    refuse(at, "gauge_length", length, "a displacement or a length");
    const auto grips = at.find("grip_distance");
    if (!grips) return;
    if (sizes.gauge_length)
      grips->fail(fmt::format("\"grip_distance\" changes nothing beside a \"gauge_length\" of {:g} mm in {}",
                              *sizes.gauge_length, owner),
                  "Where displacement 0 is at the gauge length, leave \"grip_distance\" out. Where it is not, map the "
                  "length between the grips, grip_distance + displacement, as \"length\"; or give \"gauge_length\": "
                  "\"preload\" with a \"preload\", which takes the length there.");
    if (!data.specimen.gauge_at_preload || !displacement)
      grips->fail(fmt::format("\"grip_distance\" changes nothing in {}", owner),
                  "It belongs to a displacement with \"gauge_length\": \"preload\". Leave it out.");
  };
  refuse(*node, "height", plate, "a displacement of shear");
  look_at(*node, data.specimen.all);
  for (const auto& [direction, sizes] : data.specimen.directions) {
    const Node at = node->require(direction, "");
    if (std::find(directions.begin(), directions.end(), direction) == directions.end())
      at.fail(
          fmt::format("the sizes along '{}' change nothing in {}", direction, owner),
          "No force, displacement, length or strain along it is mapped. Map one in \"columns\", or leave them out.");
    if (const auto width = at.find("width"); width && data.specimen.area)
      width->fail(fmt::format("\"width\" changes nothing beside \"area\" in {}", owner),
                  "Give the area of the section, or its two sides.");
    look_at(at, data::sizes_along(data.specimen, "stretch_" + direction));
  }
}

}  // namespace

void check_sizes(const Node& block, std::string_view owner, const std::vector<Observable>& observables,
                 const data::DataRequest& data) {
  refuse_idle_sizes(block, owner, observables, data);
  require_sizes(block, owner, observables, data);
}

}  // namespace tunica::experiment
