// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <exception>
#include <new>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/limits.hpp"
#include "experiment/materials.hpp"
#include "experiment/schema_parts.hpp"
#include "plugins/guarded.hpp"

namespace tunica::experiment {
namespace {

using Role = Observable::Role;
using ModelInCatalogue = plugins::Catalogue::Entry<ModelFactory>;

std::string described(const std::string& doc, const std::string& reference, const std::string& plugin) {
  return fmt::format("{}{}{} (plugin {})", doc, reference.empty() ? "" : " – ", reference, plugin);
}

Json with_options(const std::string& type, const std::vector<Option>& options) {
  Json properties = Json::object();
  properties["type"]["const"] = type;
  for (const Option& option : options) properties[option.name] = option_schema(option);
  return properties;
}

std::vector<std::string> required_keys(const std::vector<Option>& options, std::vector<std::string> others) {
  for (const Option& option : options)
    if (!option.fallback) others.push_back(option.name);
  return others;
}

/// Values worth trying for an option, to see whether the model's parameters depend on it.
std::vector<Option::Value> alternatives(const Option& option) {
  std::vector<Option::Value> values;
  if (option.fallback) values.push_back(*option.fallback);
  if (option.kind == Option::Kind::flag) values.insert(values.end(), {true, false});
  if (option.kind == Option::Kind::choice) values.insert(values.end(), option.choices.begin(), option.choices.end());
  if (option.kind == Option::Kind::integer) {
    const auto first = static_cast<std::int64_t>(std::clamp(option.min.value_or(1), -1e6, 1e6));
    const auto last = static_cast<std::int64_t>(std::clamp(option.max.value_or(10), -1e6, 1e6));
    for (std::int64_t i = first; i <= std::min(last, first + 9); ++i) values.emplace_back(i);
  }
  return values;
}

void add_parameters(const ModelInCatalogue& entry, const Options& options, std::vector<Parameter>& parameters) {
  try {
    const auto model = plugins::create(entry, options);
    for (const Parameter& parameter : model->describe().parameters)
      if (std::none_of(parameters.begin(), parameters.end(),
                       [&](const Parameter& p) { return p.name == parameter.name; }))
        parameters.push_back(parameter);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // these options do not go together: no parameters to learn from them
  }
}

/// Every parameter the model has under its default options or with one of them changed.
std::vector<Parameter> possible_parameters(const ModelInCatalogue& entry) {
  const ModelFactory& factory = entry.factory;
  Options defaults;
  for (const Option& option : factory.options) {
    const auto values = alternatives(option);
    if (!values.empty()) defaults.set(option.name, values.front());
  }
  std::vector<Parameter> parameters;
  add_parameters(entry, defaults, parameters);
  for (const Option& option : factory.options)
    for (const Option::Value& value : alternatives(option)) {
      Options changed = defaults;
      changed.set(option.name, value);
      add_parameters(entry, changed, parameters);
    }
  return parameters;
}

Json mechanism_list(const std::vector<std::string>& types) {
  return {{"description", "Mechanisms to include, in any order."},
          {"type", "array"},
          {"items", by_type("mechanism", types, "One mechanism.")},
          {"maxItems", limits::entries}};
}

Json layers_schema() {
  Json layer = object_schema("A layer with a model of its own.",
                             {{"model", {{"description", "Name of a model."}, {"type", "string"}, {"minLength", 1}}},
                              {"thickness", quantity_schema("Its thickness in the unloaded wall [mm].")}},
                             {"model", "thickness"});
  return {{"description", "Layers of the wall from inside; without them the model of the run fills it."},
          {"type", "array"},
          {"items", std::move(layer)},
          {"minItems", 1},
          {"maxItems", limits::entries}};
}

Json data_schema(const TestFactory& factory) {
  Json properties = Json::object();
  properties["file"] = {{"description", "The data file, relative to the experiment file."}, {"type", "string"}};
  properties["files"] = {{"description", "Replicates: same abscissae, else interpolated."},
                         {"type", "array"},
                         {"items", {{"type", "string"}}},
                         {"minItems", 1},
                         {"maxItems", limits::entries}};
  properties["numbered_files"] = {
      {"description",
       "One table a file, \"frame_*.csv\": the number for the star is the prescribed quantity that no column gives."},
      {"type", "string"}};
  Json constants = Json::object();
  for (const Observable& observable : factory.observables)
    if (observable.role == Role::abscissa)
      constants[observable.name] = quantity_schema(fmt::format("{} [{}]", observable.doc, observable.unit));
  if (!constants.empty())
    properties["constant"] =
        object_schema("Prescribed quantities that are the same in all rows.", std::move(constants));
  Json columns = columns_schema(factory.observables);
  // A quantity that every row needs has a column, unless it is the number of a file or a constant.
  Json needed = Json::object();
  for (const char* key : {"required", "allOf"})
    if (columns.contains(key)) {
      needed[key] = columns[key];
      columns.erase(key);
    }
  properties["columns"] = std::move(columns);
  for (const char* name : {"stress_measure", "rows", "where", "order", "time_from"}) properties[name] = reference(name);
  add_rig_properties(properties, factory.observables);
  Json per_channel = Json::object();
  for (const Observable& observable : factory.observables)
    if (observable.role == Role::channel) per_channel[observable.name] = reference("noise");
  properties["noise"]["description"] =
      "Standard deviation of the data: one for all channels, or one per channel; absent = estimated.";
  properties["noise"]["anyOf"] =
      Json::array({reference("noise"), object_schema("By channel.", std::move(per_channel))});
  Json schema = object_schema("The measured data.", std::move(properties), {"columns"});
  if (!needed.empty())
    schema["anyOf"] = Json::array({{{"properties", {{"columns", std::move(needed)}}}},
                                   {{"required", {"numbered_files"}}},
                                   {{"required", {"constant"}}}});
  schema["oneOf"] =
      Json::array({{{"required", {"file"}}}, {{"required", {"files"}}}, {{"required", {"numbered_files"}}}});
  return schema;
}

}  // namespace

void define_plugins(Json& definitions, const plugins::Catalogue& catalogue) {
  std::vector<std::string> of_models;
  for (const auto& [id, entry] : catalogue.mechanisms()) {
    const MechanismFactory& factory = entry.factory;
    if (factory.stage < Stage::test) of_models.push_back(id);
    Json properties = with_options(id, factory.options);
    properties["parameters"] = parameters_schema(factory.parameters);
    if (factory.parameters_of) properties["parameters"]["additionalProperties"] = reference("parameter");
    if (factory.native.empty())
      properties["as"] = {{"type", "string"},
                          {"description", "Name of its parameters, where several of a type stand side by side."}};
    definitions["mechanism_" + id] = object_schema(described(factory.cause, factory.reference, entry.plugin),
                                                   std::move(properties), required_keys(factory.options, {"type"}));
  }
  for (const auto& [type, entry] : catalogue.models()) {
    const ModelFactory& factory = entry.factory;
    Json properties = with_options(type, factory.options);
    properties["parameters"] = parameters_schema(possible_parameters(entry));
    const auto names_parameters = [](const Option& option) { return option.kind == Option::Kind::json; };
    if (std::any_of(factory.options.begin(), factory.options.end(), names_parameters))
      properties["parameters"]["additionalProperties"] = reference("parameter");
    properties["mechanisms"] = mechanism_list(of_models);
    if (!properties.contains(material_key))
      properties[material_key] = {
          {"description",
           "What it is: measured stiffness far from published ones of this material is worth a question of units."},
          {"enum", known_materials()}};
    definitions["model_" + type] = object_schema(described(factory.doc, factory.reference, entry.plugin),
                                                 std::move(properties), required_keys(factory.options, {"type"}));
  }
  for (const auto& [type, entry] : catalogue.tests()) {
    const TestFactory& factory = entry.factory;
    std::vector<std::string> applicable;
    for (const auto& [id, mechanism] : catalogue.mechanisms()) {
      const auto& types = mechanism.factory.applies_to;
      if (mechanism.factory.stage >= Stage::test &&
          (types.empty() || std::find(types.begin(), types.end(), type) != types.end()))
        applicable.push_back(id);
    }
    Json properties = with_options(type, factory.options);
    if (factory.layered) properties["layers"] = layers_schema();
    definitions["data_" + type] = data_schema(factory);
    properties["data"] = {{"description", "The measured data: one table, or several whose rows follow one another."},
                          {"anyOf", Json::array({reference("data_" + type),
                                                 {{"type", "array"},
                                                  {"items", reference("data_" + type)},
                                                  {"minItems", 1},
                                                  {"maxItems", limits::entries}}})}};
    for (const char* name : {"weight", "hold_out"}) properties[name] = reference(name);
    if (!properties.contains("state")) properties["state"] = reference("state_name");
    properties["parameters"] = parameters_schema(factory.parameters);
    properties["mechanisms"] = mechanism_list(applicable);
    definitions["test_" + type] =
        object_schema(described(factory.doc, factory.reference, entry.plugin), std::move(properties),
                      required_keys(factory.options, {"type", "data"}));
  }
  for (const auto& [type, entry] : catalogue.optimizers())
    definitions["optimizer_" + type] =
        object_schema(described(entry.factory.doc, entry.factory.reference, entry.plugin),
                      with_options(type, entry.factory.options), required_keys(entry.factory.options, {"type"}));
}

}  // namespace tunica::experiment
