// SPDX-License-Identifier: Apache-2.0
// The keys of a "data" block for files as a testing machine writes them.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "data/quantities.hpp"
#include "data/units.hpp"
#include "experiment/blocks.hpp"
#include "experiment/limits.hpp"
#include "experiment/suggest.hpp"

namespace tunica::experiment {
namespace {

using data::DataRequest;
using TableKey = Key<DataRequest>;

/// A key of the layout of a table, which is a member of the request.
template <class Member, class Parse>
TableKey layout_key(std::string name, Json schema, Member data::TableLayout::*member, Parse parse) {
  return {std::move(name), [=] { return schema; },
          [=](const Node& node, DataRequest& data) { data.layout.*member = parse(node); }};
}

TableKey skip_lines_key() {
  TableKey key =
      layout_key("skip_lines", count_schema("Lines before the header of the table (default: found).", 0, limits::lines),
                 &data::TableLayout::skip_lines,
                 [](const Node& node) { return node.count("a number of lines", 0, limits::lines); });
  key.write = [](const DataRequest& data) { return written(data.layout.skip_lines); };
  return key;
}

TableKey delimiter_key() {
  TableKey key =
      layout_key("delimiter", choice_schema("What stands between cells (default: found).", {",", ";", "tab", "space"}),
                 &data::TableLayout::delimiter, [](const Node& node) {
                   static const std::map<std::string, char> delimiters = {{",", ','},   {";", ';'},     {"tab", '\t'},
                                                                          {"\t", '\t'}, {"space", ' '}, {" ", ' '}};
                   const std::string& mark = node.text("a delimiter");
                   const auto found = delimiters.find(mark);
                   if (found == delimiters.end()) node.fail_expected("\",\", \";\", \"tab\" or \"space\"");
                   return found->second;
                 });
  key.write = [](const DataRequest& data) {
    const auto& mark = data.layout.delimiter;
    if (!mark) return Json();
    return Json(*mark == '\t' ? "tab" : *mark == ' ' ? "space" : std::string(1, *mark));
  };
  return key;
}

TableKey decimal_key() {
  TableKey key = layout_key("decimal", choice_schema("The decimal mark (default: found).", {".", ","}),
                            &data::TableLayout::decimal, [](const Node& node) {
                              const std::string& mark = node.text("a decimal mark");
                              if (mark != "," && mark != ".") node.fail_expected("\",\" or \".\"");
                              return mark.front();
                            });
  key.read = [read = key.read](const Node& node, DataRequest& data) {
    read(node, data);
    if (data.layout.delimiter == ',' && data.layout.decimal == ',')
      node.fail("the comma is the delimiter and the decimal mark", "One of them is another character; correct it.");
  };
  key.write = [](const DataRequest& data) {
    return data.layout.decimal ? Json(std::string(1, *data.layout.decimal)) : Json();
  };
  return key;
}

TableKey units_key() {
  Json schema = {{"description", "Column → unit, where the header has none or a wrong one."}, {"type", "object"}};
  schema["additionalProperties"]["type"] = "string";
  return {"units", [=] { return schema; },
          [](const Node& node, DataRequest& data) {
            for (const auto& [column, unit] : node.members("an object of column names and units")) {
              const std::string& text = unit.text("a unit");
              const bool weight = text == "g" || text == "kg" || text == "mg";
              if (!weight && !data::is_unit(text))
                unit.fail(fmt::format("unknown unit '{}'", excerpt(text)),
                          "Units are spelled as in UDUNITS-2, for example N, mN, mm, um, kPa, mmHg, s, %.");
              data.layout.units.emplace_back(column, text);
            }
          },
          [](const DataRequest& data) {
            Json json;
            for (const auto& [column, unit] : data.layout.units) json[column] = unit;
            return json;
          }};
}

/// "positive", or column → "positive" | "negative".
TableKey compression_key() {
  static const std::vector<std::string> signs = {"positive", "negative"};
  const auto schema = [] {
    const Json sign = {{"enum", signs}};
    Json each = {{"type", "object"}, {"additionalProperties", sign}};
    Json either = {
        {"description",
         "Sign that forces, stresses, displacements and strains of the file have in compression (default negative); of "
         "all columns, or column → sign."}};
    either["anyOf"] = Json::array({sign, std::move(each)});
    return either;
  };
  return {"compression", schema,
          [](const Node& node, DataRequest& data) {
            data::CompressionPositive& compression = data.compression;
            compression.said = true;
            if (node.is_text()) {
              compression.all = node.one_of(signs, "sign of compression") == "positive";
              return;
            }
            for (const auto& [column, sign] :
                 node.members("\"positive\", \"negative\", or an object of columns and these words,"))
              if (sign.one_of(signs, "sign of compression") == "positive") compression.columns.push_back(column);
          },
          [](const DataRequest& data) {
            const data::CompressionPositive& compression = data.compression;
            if (compression.all) return Json("positive");
            if (compression.said && compression.columns.empty()) return Json("negative");
            Json json;
            for (const std::string& column : compression.columns) json[column] = "positive";
            return json;
          }};
}

/// A force, or a stress where no force is mapped.
TableKey preload_key(const std::vector<Observable>& observables) {
  return {"preload",
          [] {
            return quantity_schema(
                "Load at which the test begins: a force, or a stress where no force is mapped; rows below are left "
                "out.");
          },
          [&observables](const Node& node, DataRequest& data) {
            const bool force = std::any_of(data.columns.begin(), data.columns.end(), [&](const auto& column) {
              return data::quantity_named(column.first, observables)->unit == "mN";
            });
            data.preload = {node.quantity(force ? "mN" : "kPa", "the load at which the test begins"), force};
            if (data.preload->value == 0)
              node.fail("the preload is 0",
                        "Leave it out, or give the load at which the test begins, less than zero in compression.");
          },
          [](const DataRequest& data) { return data.preload ? Json(data.preload->value) : Json(); }};
}

TableKey specimen_key(const std::vector<Observable>& observables) {
  return {"specimen", [&observables] { return specimen_block(observables, true).schema(); },
          [&observables](const Node& node, DataRequest& data) {
            specimen_block(observables, data.preload.has_value()).read(node, data.specimen);
            check_specimen(node, data.specimen);
          },
          [&observables](const DataRequest& data) {
            Json json = specimen_block(observables, true).write(data.specimen);
            return json.empty() ? Json() : json;
          }};
}

TableKey cycle_key() {
  const auto schema = [] {
    const Json number = {{"type", "integer"}, {"minimum", 1}, {"maximum", limits::lines}};
    Json list = {{"type", "array"}, {"items", number}, {"minItems", 1}};
    Json either = {{"description", "Cycles to use, counted from 1; \"all\" are the history of loading."}};
    either["anyOf"] = Json::array({Json{{"enum", {"last", "all"}}}, number, std::move(list)});
    return either;
  };
  const auto read = [](const Node& node, DataRequest& data) {
    data::CycleChoice& choice = data.cycle.emplace();
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
  };
  const auto write = [](const DataRequest& data) {
    if (!data.cycle) return Json();
    if (!data.cycle->numbers.empty()) return Json(data.cycle->numbers);
    return Json(data.cycle->last ? "last" : "all");
  };
  return {"cycle", schema, read, write};
}

TableKey cycles_from_key() {
  return {
      "cycles_from",
      [] {
        return column_schema(
            "Column whose first number is that of the cycle (default: cycles are found from the turning points).");
      },
      [](const Node& node, DataRequest& data) {
        data.cycles_from = read_column_name(node);
        if (!data.cycle)
          node.fail("\"cycles_from\" names a column of cycles, and no \"cycle\" is chosen",
                    "Add \"cycle\": \"last\", \"all\", a number or a list.");
      },
      [](const DataRequest& data) { return data.cycles_from.empty() ? Json() : write_column_name(data.cycles_from); }};
}

}  // namespace

Json column_schema(std::string_view description) {
  return {{"description", description},
          {"type", {"string", "integer"}},
          {"minLength", 1},
          {"minimum", 1},
          {"maximum", limits::lines}};
}

std::string read_column_name(const Node& node) {
  if (node.is_number()) return fmt::format("#{}", node.count("the number of a column", 1, limits::lines));
  const std::string& name = node.text("the name of a column, or its number");
  if (name.empty()) node.fail_expected("the name of a column, or its number");
  return name;
}

Json write_column_name(const std::string& name) {
  const auto position = data::column_position(name);
  return position ? Json(*position) : Json(name);
}

std::vector<Key<DataRequest>> rig_keys(const std::vector<Observable>& observables) {
  TableKey branch = code_key("branch", "Only the loading, or the unloading, of the cycles (default both).",
                             &DataRequest::branch, data::branch_names, "branch");
  return {defined(skip_lines_key()),
          defined(delimiter_key()),
          defined(decimal_key()),
          defined(units_key()),
          defined(compression_key()),
          defined(preload_key(observables)),
          specimen_key(observables),
          defined(cycle_key()),
          defined(cycles_from_key()),
          defined(count_key("resample",
                            "Points in place of each branch, by local regression; the scatter becomes the noise.",
                            &DataRequest::resample, "a number of points", 5, limits::resampled)),
          defined(silent_at(std::move(branch), ""))};
}

}  // namespace tunica::experiment
