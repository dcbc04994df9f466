// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/quantities.hpp"
#include "experiment/enum_names.hpp"
#include "experiment/limits.hpp"
#include "experiment/schema_parts.hpp"

/// The keys of a "data" block for files as a testing machine writes them.
namespace tunica::experiment {
namespace {

Json column_schema(std::string_view description) {
  return {{"description", description},
          {"type", {"string", "integer"}},
          {"minLength", 1},
          {"minimum", 1},
          {"maximum", limits::lines}};
}

Json sizes_schema() {
  Json gauge = quantity_schema("Length at stretch 1 [mm], or \"preload\": that at the preload.");
  gauge["pattern"] = "^( *[+-]?[0-9.]|preload$)";
  return {{"width", quantity_schema("Width across the force [mm].")},
          {"gauge_length", std::move(gauge)},
          {"grip_distance",
           quantity_schema("Length at displacement 0 [mm], where the gauge length is that at the preload.")}};
}

}  // namespace

void define_rig_keys(Json& definitions) {
  definitions["skip_lines"] = {{"description", "Lines before the header of the table (default: found)."},
                               {"type", "integer"},
                               {"minimum", 0},
                               {"maximum", limits::lines}};
  definitions["delimiter"] = {{"description", "What stands between cells (default: found)."},
                              {"enum", {",", ";", "tab", "space"}}};
  definitions["decimal"] = {{"description", "The decimal mark (default: found)."}, {"enum", {".", ","}}};
  definitions["units"] = {{"description", "Column → unit, where the header has none or a wrong one."},
                          {"type", "object"},
                          {"additionalProperties", {{"type", "string"}}}};
  Json number = {{"type", "integer"}, {"minimum", 1}, {"maximum", limits::lines}};
  definitions["cycle"] = {{"description", "Cycles to use, counted from 1; \"all\" are the history of loading."}};
  definitions["cycle"]["anyOf"] =
      Json::array({{{"enum", {"last", "all"}}}, number, {{"type", "array"}, {"items", number}, {"minItems", 1}}});
  definitions["cycles_from"] = column_schema(
      "Column whose first number is that of the cycle (default: cycles are found from the turning points).");
  definitions["resample"] = {
      {"description", "Points in place of each branch, by local regression; the scatter becomes the noise."},
      {"type", "integer"},
      {"minimum", 5},
      {"maximum", limits::resampled}};
  definitions["branch"] = {{"description", "Only the loading, or the unloading, of the cycles (default both)."},
                           {"enum", names_in(data::branch_names)}};
  const Json sign = {{"enum", {"positive", "negative"}}};
  definitions["compression"] = {
      {"description",
       "Sign that forces, stresses, displacements and strains of the file have in compression (default negative); of "
       "all columns, or column → sign."}};
  definitions["compression"]["anyOf"] = Json::array({sign, {{"type", "object"}, {"additionalProperties", sign}}});
  definitions["preload"] = quantity_schema(
      "Load at which the test begins: a force, or a stress where no force is mapped; rows below are left out.");
}

Json specimen_schema(const std::vector<Observable>& observables) {
  Json properties = sizes_schema();
  properties["thickness"] = quantity_schema("Thickness [mm].");
  properties["area"] = quantity_schema("Area of the section, in place of width and thickness [mm2].");
  if (data::shears(observables)) properties["height"] = quantity_schema("Distance of the plates [mm].");
  for (const std::string& direction : data::directions_of(observables))
    properties[direction] = object_schema("Sizes along this direction.", sizes_schema());
  return object_schema("Sizes of the unloaded specimen.", std::move(properties));
}

void add_rig_properties(Json& properties, const std::vector<Observable>& observables) {
  for (const char* name : {"skip_lines", "delimiter", "decimal", "units", "cycle", "cycles_from", "branch", "preload",
                           "resample", "compression"})
    properties[name] = reference(name);
  properties["specimen"] = specimen_schema(observables);
}

Json columns_schema(const std::vector<Observable>& observables) {
  Json properties = Json::object(), needed = Json::array();
  std::vector<std::string> required;
  const std::vector<data::RawName> raw_names = data::raw_names(observables);
  for (const Observable& observable : observables) {
    const char* role = observable.role == Observable::Role::abscissa ? "prescribed"
                       : observable.role == Observable::Role::time   ? "clock"
                                                                     : "measured and fitted";
    properties[observable.name] =
        column_schema(fmt::format("{} ({})", with_unit(observable.doc, observable.unit), role));
    Json any = Json::array({{{"required", {observable.name}}}});
    for (const data::RawName& raw : raw_names)
      if (raw.quantity.observable->name == observable.name) any.push_back({{"required", {raw.name}}});
    if (observable.required && any.size() == 1) required.push_back(observable.name);
    Json either = Json::object();
    either["anyOf"] = std::move(any);
    if (observable.required && either["anyOf"].size() > 1) needed.push_back(std::move(either));
  }
  for (const data::RawName& raw : raw_names)
    properties[raw.name] = column_schema(
        fmt::format("{}, with the sizes of the specimen.",
                    with_unit(fmt::format("Gives '{}'", raw.quantity.observable->name), raw.quantity.unit)));
  Json schema = object_schema("Observable of the test, or a quantity that gives one → name or number of the column.",
                              std::move(properties), required);
  schema["minProperties"] = 1;
  if (!needed.empty()) schema["allOf"] = std::move(needed);
  return schema;
}

}  // namespace tunica::experiment
