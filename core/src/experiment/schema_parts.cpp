// SPDX-License-Identifier: Apache-2.0
#include "experiment/schema_parts.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/enum_names.hpp"
#include "experiment/limits.hpp"

namespace tunica::experiment {

std::string with_unit(std::string_view doc, std::string_view unit) {
  if (doc.ends_with('.')) doc.remove_suffix(1);
  return unit.empty() || unit == "1" ? std::string(doc) : fmt::format("{} [{}]", doc, unit);
}

Json object_schema(std::string_view description, Json properties, const std::vector<std::string>& required) {
  Json schema = {{"description", description},
                 {"type", "object"},
                 {"properties", std::move(properties)},
                 {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json reference(std::string_view name, std::string_view description) {
  Json target = Json::object();
  target["$ref"] = fmt::format("#/definitions/{}", name);
  if (description.empty()) return target;
  // Draft 7 ignores all keys beside a $ref.
  Json schema = {{"description", description}};
  schema["allOf"] = Json::array({std::move(target)});
  return schema;
}

Json quantity_schema(std::string_view description) {
  return {{"description", description}, {"type", {"number", "string"}}, {"pattern", "^ *[+-]?[0-9.]"}};
}

Json text_schema(std::string_view description) { return {{"description", description}, {"type", "string"}}; }

Json flag_schema(std::string_view description) { return {{"description", description}, {"type", "boolean"}}; }

Json choice_schema(std::string_view description, const std::vector<std::string>& names) {
  return {{"description", description}, {"enum", names}};
}

Json count_schema(std::string_view description, std::uint64_t at_least, std::optional<std::uint64_t> at_most) {
  Json schema = {{"description", description}, {"type", "integer"}, {"minimum", at_least}};
  if (at_most) schema["maximum"] = *at_most;
  return schema;
}

Json number_schema(std::string_view description, double least, double most) {
  return {{"description", description}, {"type", "number"}, {"minimum", least}, {"maximum", most}};
}

Json list_schema(std::string_view description, Json items) {
  return {{"description", description}, {"type", "array"}, {"items", std::move(items)}, {"maxItems", limits::entries}};
}

Json named_entries_schema(std::string_view description, Json entry) {
  Json schema = {{"description", description},
                 {"type", "object"},
                 {"minProperties", 1},
                 {"maxProperties", limits::entries},
                 {"additionalProperties", std::move(entry)}};
  schema["propertyNames"]["pattern"] = name_pattern;
  return schema;
}

Json option_schema(const Option& option) {
  Json schema = Json::object();
  schema["description"] = with_unit(option.doc, option.unit);
  switch (option.kind) {
    case Option::Kind::flag:
      schema["type"] = "boolean";
      break;
    case Option::Kind::integer:
      schema["type"] = "integer";
      break;
    case Option::Kind::number:
      schema["type"] = "number";
      break;
    case Option::Kind::quantity:
      schema = quantity_schema(schema["description"].get<std::string>());
      break;
    case Option::Kind::choice:
      schema["enum"] = option.choices;
      break;
    case Option::Kind::text:
      schema["type"] = "string";
      break;
    case Option::Kind::json:
      if (const Json own = Json::parse(option.schema, nullptr, false); own.is_object()) schema.update(own);
      break;  // without a schema anything: the plugin reads it
  }
  if (option.min) schema["minimum"] = *option.min;
  if (option.max) schema["maximum"] = *option.max;
  if (option.fallback) {
    if (option.kind == Option::Kind::json)
      schema["default"] = Json::parse(std::get<std::string>(*option.fallback), nullptr, false);
    else
      std::visit([&](const auto& value) { schema["default"] = value; }, *option.fallback);
  }
  return schema;
}

Json parameters_schema(const std::vector<Parameter>& parameters) {
  Json properties = Json::object();
  for (const Parameter& p : parameters)
    properties[p.name] =
        reference("parameter", fmt::format("{}. Default: {} within {} to {}, scale {}.{}{}", with_unit(p.doc, p.unit),
                                           p.initial, p.min, p.max, text::code_of(scale_names, p.scale),
                                           p.reference.empty() ? "" : " ", p.reference));
  return object_schema("Bounds, start, scale of parameters, by name; what is left out keeps its default.",
                       std::move(properties));
}

Json by_type(std::string_view prefix, const std::vector<std::string>& types, std::string_view description) {
  Json schema = {{"description", description}, {"type", "object"}, {"required", {"type"}}};
  schema["properties"]["type"]["enum"] = types;
  Json cases = Json::array();
  for (const std::string& type : types) {
    Json one = Json::object();
    one["if"]["properties"]["type"]["const"] = type;
    one["then"] = reference(fmt::format("{}_{}", prefix, type));
    cases.push_back(std::move(one));
  }
  if (!types.empty()) schema["allOf"] = std::move(cases);
  return schema;
}

std::string described(const std::string& doc, const std::string& reference, const std::string& plugin) {
  return fmt::format("{}{}{} (plugin {})", doc, reference.empty() ? "" : " – ", reference, plugin);
}

}  // namespace tunica::experiment
