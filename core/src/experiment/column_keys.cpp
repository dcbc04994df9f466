// SPDX-License-Identifier: Apache-2.0
// Which column, constant or number of a file gives which observable.
#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "data/quantities.hpp"
#include "experiment/blocks.hpp"
#include "experiment/suggest.hpp"

namespace tunica::experiment {
namespace {

using Role = Observable::Role;

std::vector<std::string> observable_names(const std::vector<Observable>& observables) {
  std::vector<std::string> names;
  for (const Observable& observable : observables) names.push_back(observable.name);
  return names;
}

/// Names that "columns" may have: the observables, and what they follow from.
std::vector<std::string> column_names(const std::vector<Observable>& observables) {
  std::vector<std::string> names = observable_names(observables);
  for (const data::RawName& raw : data::raw_names(observables)) names.push_back(raw.name);
  return names;
}

std::string sources_of(const Observable& observable, const std::vector<Observable>& observables) {
  std::vector<std::string> sources;
  for (const data::RawName& raw : data::raw_names(observables))
    if (raw.quantity.observable->name == observable.name) sources.push_back("'" + raw.name + "'");
  return sources.empty() ? "" : fmt::format(" It may also follow from {}.", fmt::join(sources, ", "));
}

void read_columns(const Node& node, const std::vector<Observable>& observables, std::string_view owner,
                  data::DataRequest& data) {
  std::map<std::string, std::string> mapped;  // observable → the name that gives it
  for (const auto& [name, column] : node.members("an object that maps observables to column names")) {
    const auto quantity = data::quantity_named(name, observables);
    if (!quantity)
      column.fail(fmt::format("unknown observable '{}' of {}", excerpt(name), owner),
                  suggestion(name, column_names(observables)));
    const auto [first, is_new] = mapped.emplace(quantity->observable->name, name);
    if (!is_new)
      column.fail(
          fmt::format("'{}' and '{}' both give the {} of {}", first->second, name, quantity->observable->name, owner),
          "Leave out one.");
    data.columns.emplace_back(name, read_column_name(column));
  }
  for (const auto& [name, value] : data.constants)
    if (!mapped.emplace(name, name).second)
      node.fail(fmt::format("'{}' has a column and a constant in the data of {}", name, owner), "Leave out one.");
  for (const Observable& observable : observables)
    if (observable.required && !mapped.contains(observable.name))
      node.fail(fmt::format("no column is mapped to '{}', which {} needs", observable.name, owner),
                fmt::format("Add it. {}{}", observable.doc, sources_of(observable, observables)));
}

/// Prescribed quantities that are the same in all rows of a table.
void read_constants(const Node& node, const std::vector<Observable>& observables, std::string_view owner,
                    data::DataRequest& data) {
  std::vector<std::string> prescribed;
  for (const Observable& observable : observables)
    if (observable.role == Role::abscissa) prescribed.push_back(observable.name);
  for (const auto& [name, value] : node.members("an object of prescribed quantities and their values")) {
    const auto found = std::ranges::find(observables, name, &Observable::name);
    if (found == observables.end() || found->role != Role::abscissa)
      value.fail(fmt::format("'{}' is no prescribed quantity of {}", excerpt(name), owner),
                 suggestion(name, prescribed));
    data.constants.emplace_back(name, value.quantity(found->unit, fmt::format("the value of '{}'", name)));
  }
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

}  // namespace

Key<data::DataRequest> columns_key(const std::vector<Observable>& observables, const std::string& owner) {
  return required<data::DataRequest>({"columns", [&observables] { return columns_schema(observables); },
                                      [&observables, owner](const Node& node, data::DataRequest& data) {
                                        read_columns(node, observables, owner, data);
                                      },
                                      [](const data::DataRequest& data) {
                                        Json json;
                                        for (const auto& [observable, column] : data.columns)
                                          json[observable] = write_column_name(column);
                                        return json;
                                      }});
}

Key<data::DataRequest> constant_key(const std::vector<Observable>& observables, const std::string& owner) {
  const auto schema = [&observables] {
    Json constants = Json::object();
    for (const Observable& observable : observables)
      if (observable.role == Role::abscissa)
        constants[observable.name] = quantity_schema(fmt::format("{} [{}]", observable.doc, observable.unit));
    return object_schema("Prescribed quantities that are the same in all rows.", std::move(constants));
  };
  return {"constant", schema,
          [&observables, owner](const Node& node, data::DataRequest& data) {
            read_constants(node, observables, owner, data);
          },
          [](const data::DataRequest& data) {
            Json json;
            for (const auto& [observable, value] : data.constants) json[observable] = value;
            return json;
          }};
}

/// The number of a file is the first prescribed quantity that every row needs and nothing else gives.
void read_number(const Node& block, const std::vector<Observable>& observables, std::string_view owner, double number,
                 data::DataRequest& data) {
  std::set<std::string> given;
  if (const auto constants = block.find("constant"); constants && constants->is_object())
    for (const auto& [name, value] : constants->members("")) given.insert(name);
  if (const auto columns = block.find("columns"); columns && columns->is_object())
    for (const auto& [name, column] : columns->members(""))
      if (const auto quantity = data::quantity_named(name, observables)) given.insert(quantity->observable->name);
  for (const Observable& observable : observables)
    if (observable.role == Role::abscissa && observable.required && !given.contains(observable.name)) {
      data.constants.emplace_back(observable.name, number);
      return;
    }
  block.fail(fmt::format("the number of a file means nothing in {}: every quantity that a row needs is given", owner),
             "Take its column out, or name the files in \"data\": [{\"file\": …}, …].");
}

}  // namespace tunica::experiment
