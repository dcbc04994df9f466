// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "experiment/blocks.hpp"
#include "experiment/limits.hpp"
#include "experiment/reader.hpp"

namespace tunica::experiment {
namespace {

const std::vector<std::string> constraint_types = {"transverse_stability", "admissible_parameters"};

/// The sub-critical factor h of the stability constraint: a number, or a table over stretch.
StabilityFactor read_stability_factor(const Node& node) {
  constexpr std::string_view expected = "a number from 0 to 1, or a table [[stretch, h], …] with rising stretches,";
  const auto factor = [&](const Node& h) {
    if (!h.is_number() || h.number("") < 0 || h.number("") > 1) h.fail_expected(expected);
    return h.number("");
  };
  if (!node.is_array()) return {{1, factor(node)}};
  const auto rows = node.elements(expected);
  if (rows.empty()) node.fail_expected(expected);
  StabilityFactor table;
  for (const Node& row : rows) {
    if (!row.is_array() || row.size() != 2) row.fail_expected("a pair [stretch, h]");
    const double stretch = row.element(0).number("a stretch");
    if (!(stretch > (table.empty() ? 0 : table.back().first)))
      row.element(0).fail(
          fmt::format("the stretch {} does not lie above {}", stretch, table.empty() ? 0 : table.back().first),
          "Stretches of the table are positive and rise.");
    table.emplace_back(stretch, factor(row.element(1)));
  }
  return table;
}

Key<ConstraintEntry> factor_key() {
  const auto schema = [] {
    const Json factor = {{"type", "number"}, {"minimum", 0}, {"maximum", 1}};
    Json pair = {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}};
    pair["items"] = Json::array({Json{{"type", "number"}, {"exclusiveMinimum", 0}}, factor});
    Json table = list_schema("h over stretch.", std::move(pair));
    table["minItems"] = 1;
    Json h = {{"description", "1 is the criterion itself; a number, or a table [[stretch, h], …]."}};
    h["anyOf"] = Json::array({factor, std::move(table)});
    return h;
  };
  return member_key("h", schema, &ConstraintEntry::h, read_stability_factor);
}

Key<ConstraintEntry> range_key() {
  const auto schema = [] {
    Json range = list_schema("Stretches from, to: besides those that were measured.", Json{{"type", "number"}});
    range["minItems"] = 2;
    range["maxItems"] = 2;
    return range;
  };
  return member_key("range", schema, &ConstraintEntry::range, [](const Node& node) {
    constexpr std::string_view expected = "two stretches [from, to], 0 < from < to,";
    if (!node.is_array() || node.size() != 2) node.fail_expected(expected);
    const double from = node.element(0).number(expected), to = node.element(1).number(expected);
    if (!(from > 0 && from < to))
      node.fail(fmt::format("the range goes from {} to {}", from, to),
                "Expected two stretches [from, to], 0 < from < to.");
    return std::pair(from, to);
  });
}

Key<ConstraintEntry> directions_key() {
  static const std::vector<std::string> names = {"circumferential", "axial"};
  const auto schema = [] {
    Json directions = {{"description", "Strips along which axes (default both)."}};
    directions["anyOf"] = Json::array({Json{{"enum", names}}, list_schema("Several.", Json{{"enum", names}})});
    return directions;
  };
  return member_key("directions", schema, &ConstraintEntry::directions, [](const Node& node) {
    std::array<bool, 2> directions = {false, false};
    const auto add = [&](const Node& name) { directions[name.one_of(names, "direction") == names[0] ? 0 : 1] = true; };
    if (node.is_text())
      add(node);
    else
      for (const Node& name : node.elements("a direction, or a list of them,")) add(name);
    return directions;
  });
}

Key<ConstraintEntry> type_key(const std::string& type) {
  return required(member_key(
      "type",
      [=] {
        return Json{{"const", type}};
      },
      &ConstraintEntry::type, [=](const Node& node) { return node.one_of(constraint_types, "constraint"); }));
}

Block<ConstraintEntry> constraint_block(const std::string& type) {
  const std::string owner = fmt::format("the constraint '{}'", type);
  if (type != constraint_types.front())
    return {owner, "The inequalities that the model declares between its parameters.", {type_key(type)}};
  return {owner,
          "The transverse stretch λ3 falls as the strip is pulled: d ln λ3/d ln λ1 ≤ −(1 − h)/2.",
          {type_key(type), factor_key(), range_key(),
           count_key("points", "Evenly spaced stretches in place of every measured one.", &ConstraintEntry::points,
                     "a whole number of stretches", 2, limits::stability_points),
           directions_key()}};
}

}  // namespace

std::vector<ConstraintEntry> read_constraints(const Node& node) {
  std::vector<ConstraintEntry> constraints;
  for (const Node& entry : node.elements("a list of constraints, [ {\"type\": …}, … ],")) {
    entry.expect_object("a constraint, {\"type\": …},");
    ConstraintEntry constraint;
    constraint.json = entry.dumped();
    constraint.pointer = entry.place();
    constraint_block(entry.require("type", "a constraint").one_of(constraint_types, "constraint"))
        .read(entry, constraint);
    constraints.push_back(std::move(constraint));
  }
  return constraints;
}

Json constraints_schema() {
  Json either = {{"description", "A condition on the parameters."}};
  for (const std::string& type : constraint_types) either["anyOf"].push_back(constraint_block(type).schema());
  return list_schema("Conditions on the parameters.", std::move(either));
}

}  // namespace tunica::experiment
