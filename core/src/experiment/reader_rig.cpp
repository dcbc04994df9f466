// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "data/quantities.hpp"
#include "data/units.hpp"
#include "experiment/enum_names.hpp"
#include "experiment/limits.hpp"
#include "experiment/reader.hpp"
#include "experiment/suggest.hpp"
#include "tunica/error.hpp"

/// The keys of a "data" block for files as a testing machine writes them.
namespace tunica::experiment {
namespace {

using From = data::Quantity::Kind;

double positive(const Node& node, std::string_view unit, std::string_view what) {
  const double value = node.quantity(unit, fmt::format("the {} of the specimen", what));
  if (!(value > 0))
    node.fail(fmt::format("the {} is {} {}", what, value, unit), "It must be greater than zero. Correct it.");
  return value;
}

void read_delimiters(const Node& block, data::TableLayout& layout) {
  static const std::map<std::string, char> delimiters = {{",", ','},   {";", ';'},     {"tab", '\t'},
                                                         {"\t", '\t'}, {"space", ' '}, {" ", ' '}};
  if (const auto node = block.find("delimiter")) {
    const std::string& mark = node->text("a delimiter");
    const auto found = delimiters.find(mark);
    if (found == delimiters.end()) node->fail_expected("\",\", \";\", \"tab\" or \"space\"");
    layout.delimiter = found->second;
  }
  if (const auto node = block.find("decimal")) {
    const std::string& mark = node->text("a decimal mark");
    if (mark != "," && mark != ".") node->fail_expected("\",\" or \".\"");
    layout.decimal = mark.front();
  }
  if (layout.delimiter == ',' && layout.decimal == ',')
    block.child_or_self("decimal").fail("the comma is the delimiter and the decimal mark",
                                        "One of them is another character; correct it.");
}

void read_layout(const Node& block, data::DataRequest& data) {
  if (const auto node = block.find("skip_lines"))
    data.layout.skip_lines = node->count("a number of lines", 0, limits::lines);
  read_delimiters(block, data.layout);
  if (const auto node = block.find("units"))
    for (const auto& [column, unit] : node->members("an object of column names and units")) {
      const std::string& text = unit.text("a unit");
      const bool weight = text == "g" || text == "kg" || text == "mg";
      if (!weight && !data::is_unit(text))
        unit.fail(fmt::format("unknown unit '{}'", excerpt(text)),
                  "Units are spelled as in UDUNITS-2, for example N, mN, mm, um, kPa, mmHg, s, %.");
      data.layout.units.emplace_back(column, text);
    }
  const auto by_position = [](const auto& entry) { return data::column_position(entry.second).has_value(); };
  data.layout.by_position = std::all_of(data.columns.begin(), data.columns.end(), by_position);
}

void read_sizes(const Node& node, bool at_preload, data::Sizes& sizes, bool& gauge_at_preload) {
  if (const auto width = node.find("width")) sizes.width = positive(*width, "mm", "width");
  if (const auto grips = node.find("grip_distance")) sizes.grip_distance = positive(*grips, "mm", "grip distance");
  const auto gauge = node.find("gauge_length");
  if (!gauge) return;
  if (!gauge->is_text() || gauge->text("") != "preload") {
    sizes.gauge_length = positive(*gauge, "mm", "gauge length");
    return;
  }
  if (!at_preload)
    gauge->fail("the gauge length is that at the preload, and there is no \"preload\"",
                "Add it to the data, for example \"preload\": \"0.1 N\", or give a length.");
  gauge_at_preload = true;
}

void read_specimen(const Node& node, bool at_preload, const std::vector<Observable>& observables,
                   data::Specimen& specimen) {
  node.expect_object("the sizes of the specimen, {\"width\": …, \"thickness\": …, \"gauge_length\": …},");
  const std::vector<std::string> directions = data::directions_of(observables);
  std::vector<std::string> known = {"width", "thickness", "area", "gauge_length", "grip_distance"};
  if (data::shears(observables)) known.insert(known.end(), "height");
  known.insert(known.end(), directions.begin(), directions.end());
  node.allow_only(known, "the specimen");
  if (const auto thickness = node.find("thickness")) specimen.thickness = positive(*thickness, "mm", "thickness");
  if (const auto height = node.find("height")) specimen.height = positive(*height, "mm", "height");
  if (const auto area = node.find("area")) specimen.area = positive(*area, "mm2", "area");
  if (specimen.area && (specimen.thickness || node.find("width")))
    node.child_or_self("area").fail("the specimen has \"area\", and \"width\" or \"thickness\" too",
                                    "Give the area of the section, or its two sides.");
  read_sizes(node, at_preload, specimen.all, specimen.gauge_at_preload);
  for (const std::string& direction : directions)
    if (const auto own = node.find(direction)) {
      own->expect_object("sizes along a direction, {\"width\": …, \"gauge_length\": …},");
      own->allow_only({"width", "gauge_length", "grip_distance"}, fmt::format("the specimen along '{}'", direction));
      data::Sizes sizes;
      read_sizes(*own, at_preload, sizes, specimen.gauge_at_preload);
      specimen.directions.emplace_back(direction, sizes);
    }
}

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

data::CycleChoice read_cycle(const Node& node) {
  data::CycleChoice choice;
  const auto number = [](const Node& at) {
    return static_cast<std::size_t>(at.count("the number of a cycle", 1, limits::lines));
  };
  if (node.is_text() && node.text("") == "last")
    choice.last = true;
  else if (node.is_array())
    for (const Node& one : node.elements("")) choice.numbers.push_back(number(one));
  else if (node.is_number())
    choice.numbers.push_back(number(node));
  else if (!node.is_text() || node.text("") != "all")
    node.fail_expected("\"last\", \"all\", the number of a cycle from 1, or a list of numbers");
  if (node.is_array() && choice.numbers.empty())
    node.fail("the list of cycles is empty", "Name one, or write \"all\".");
  return choice;
}

/// "positive", or column → "positive" | "negative".
data::CompressionPositive read_compression(const Node& node) {
  static const std::vector<std::string> signs = {"positive", "negative"};
  data::CompressionPositive compression;
  compression.said = true;
  if (node.is_text()) {
    compression.all = node.one_of(signs, "sign of compression") == "positive";
    return compression;
  }
  for (const auto& [column, sign] :
       node.members("\"positive\", \"negative\", or an object of columns and these words,"))
    if (sign.one_of(signs, "sign of compression") == "positive") compression.columns.push_back(column);
  return compression;
}

data::Preload read_preload(const Node& node, const std::vector<Observable>& observables,
                           const data::DataRequest& data) {
  const bool force = std::any_of(data.columns.begin(), data.columns.end(), [&](const auto& column) {
    return data::quantity_named(column.first, observables)->unit == "mN";
  });
  const data::Preload preload{node.quantity(force ? "mN" : "kPa", "the load at which the test begins"), force};
  if (preload.value == 0)
    node.fail("the preload is 0",
              "Leave it out, or give the load at which the test begins, less than zero in compression.");
  return preload;
}

}  // namespace

const std::vector<std::string>& rig_keys() {
  static const std::vector<std::string> keys = {"skip_lines", "delimiter", "decimal",     "units",
                                                "specimen",   "cycle",     "cycles_from", "branch",
                                                "preload",    "resample",  "compression"};
  return keys;
}

std::string read_column_name(const Node& node) {
  if (node.is_number()) return fmt::format("#{}", node.count("the number of a column", 1, limits::lines));
  const std::string& name = node.text("the name of a column, or its number");
  if (name.empty()) node.fail_expected("the name of a column, or its number");
  return name;
}

void read_where(const Node& node, data::DataRequest& data) {
  const auto value_of = [](const Node& value) {
    if (!value.is_text() && !value.is_number()) value.fail_expected("the text or number to look for in the column");
    return value.is_text() ? value.text("") : value.dumped();
  };
  for (const auto& [column, value] : node.members("an object of column names and values")) {
    if (!value.is_array()) {
      data.where.emplace_back(column, value_of(value));
      continue;
    }
    if (value.size() == 0) value.fail("the list of values is empty", "Name one, or leave the column out.");
    for (const Node& one : value.elements("")) data.where.emplace_back(column, value_of(one));
  }
}

void read_rig_keys(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                   data::DataRequest& data) {
  read_layout(block, data);
  if (const auto node = block.find("compression")) data.compression = read_compression(*node);
  if (const auto node = block.find("preload")) data.preload = read_preload(*node, observables, data);
  if (const auto node = block.find("specimen"))
    read_specimen(*node, data.preload.has_value(), observables, data.specimen);
  refuse_idle_sizes(block, owner, observables, data);
  require_sizes(block, owner, observables, data);
  if (const auto node = block.find("cycle")) data.cycle = read_cycle(*node);
  if (const auto node = block.find("cycles_from")) {
    data.cycles_from = read_column_name(*node);
    if (!data.cycle)
      node->fail("\"cycles_from\" names a column of cycles, and no \"cycle\" is chosen",
                 "Add \"cycle\": \"last\", \"all\", a number or a list.");
  }
  if (const auto node = block.find("resample"))
    data.resample = static_cast<std::size_t>(node->count("a number of points", 5, limits::resampled));
  if (const auto node = block.find("branch"))
    data.branch = text::value_of(data::branch_names, node->one_of(names_in(data::branch_names), "branch")).value();
}

}  // namespace tunica::experiment
