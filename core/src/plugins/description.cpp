// SPDX-License-Identifier: Apache-2.0
#include "plugins/description.hpp"

#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "plugins/guarded.hpp"
#include "tunica/error.hpp"

namespace tunica::plugins {

namespace {

using json = nlohmann::ordered_json;

const char* word_of(Option::Kind kind) {
  switch (kind) {
    case Option::Kind::flag:
      return "flag";
    case Option::Kind::integer:
      return "integer";
    case Option::Kind::number:
      return "number";
    case Option::Kind::quantity:
      return "quantity";
    case Option::Kind::choice:
      return "choice";
    case Option::Kind::text:
      return "text";
    case Option::Kind::json:
      break;
  }
  return "json";
}

json head(const std::string& name, const std::string& doc, const std::string& reference, const std::string& plugin) {
  return {{"name", name}, {"doc", doc}, {"reference", reference}, {"plugin", plugin}};
}

json options_json(const std::vector<Option>& options) {
  json list = json::array();
  for (const auto& option : options) {
    json one = {{"name", option.name}, {"kind", word_of(option.kind)}, {"required", !option.fallback.has_value()}};
    if (option.fallback) std::visit([&](const auto& value) { one["default"] = value; }, *option.fallback);
    if (!option.unit.empty()) one["unit"] = option.unit;
    if (option.min) one["min"] = *option.min;
    if (option.max) one["max"] = *option.max;
    if (!option.choices.empty()) one["choices"] = option.choices;
    one["doc"] = option.doc;
    list.push_back(std::move(one));
  }
  return list;
}

json parameters_json(const std::vector<Parameter>& parameters, const std::vector<double>& nulls = {}) {
  json list = json::array();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& parameter = parameters[i];
    json one = {{"name", parameter.name},       {"unit", parameter.unit},
                {"initial", parameter.initial}, {"min", parameter.min},
                {"max", parameter.max},         {"scale", parameter.scale == Scale::log ? "log" : "linear"}};
    if (i < nulls.size() && !std::isnan(nulls[i])) one["held_at"] = nulls[i];
    one["doc"] = parameter.doc;
    one["reference"] = parameter.reference;
    list.push_back(std::move(one));
  }
  return list;
}

}  // namespace

Options any_options(const std::vector<Option>& options) {
  Options values;
  for (const auto& option : options) {
    if (option.fallback)
      values.set(option.name, *option.fallback);
    else if (option.kind == Option::Kind::choice && !option.choices.empty())
      values.set(option.name, option.choices.front());
    else if (option.kind == Option::Kind::number || option.kind == Option::Kind::quantity)
      values.set(option.name, option.min.value_or(option.max.value_or(1.0)));
    else if (option.kind == Option::Kind::integer)
      values.set(option.name, static_cast<std::int64_t>(option.min.value_or(1.0)));
  }
  return values;
}

TestParameters parameters_of(const Catalogue::Entry<TestFactory>& entry) {
  const auto& factory = entry.factory;
  TestSetup setup;
  setup.options = any_options(factory.options);
  setup.stress_measure = "cauchy";
  setup.rows.count = 1;
  const std::vector<double> one{1.0};
  for (const auto& observable : factory.observables) {
    if (observable.role == Observable::Role::abscissa) setup.rows.abscissae.push_back({observable.name, one});
    if (observable.role == Observable::Role::channel) setup.rows.channels.push_back(observable.name);
  }
  try {
    const auto test = plugins::create(entry, setup);
    return {test->describe().parameters, test->describe().nulls};
  } catch (const InputError&) {
    // A test is made from options and data, and these may not suit it: then what any test of the type can have.
    return {factory.parameters, {}};
  }
}

json description_json(const Catalogue::Entry<ModelFactory>& entry) {
  const auto& factory = entry.factory;
  const auto model = plugins::create(entry, any_options(factory.options));
  json document = head(factory.type, factory.doc, factory.reference, entry.plugin);
  document["parameters"] = parameters_json(model->describe().parameters);
  document["options"] = options_json(factory.options);
  if (!model->describe().formula.empty()) document["formula"] = model->describe().formula;
  document["compressible"] = model->describe().compressible;
  document["history_size"] = model->describe().history_size;
  document["energy_parts"] = json::array();
  for (const auto& part : model->parts()) document["energy_parts"].push_back(part->describe().name);
  return document;
}

json description_json(const Catalogue::Entry<TestFactory>& entry) {
  const auto& factory = entry.factory;
  json document = head(factory.type, factory.doc, factory.reference, entry.plugin);
  document["observables"] = json::array();
  for (const auto& observable : factory.observables)
    document["observables"].push_back({{"name", observable.name},
                                       {"unit", observable.unit},
                                       {"role", observable.role == Observable::Role::abscissa ? "prescribed"
                                                : observable.role == Observable::Role::time   ? "clock"
                                                                                              : "measured"},
                                       {"required", observable.required},
                                       {"doc", observable.doc}});
  const auto own = parameters_of(entry);
  document["parameters"] = parameters_json(own.parameters, own.nulls);
  document["options"] = options_json(factory.options);
  document["layers"] = factory.layered;
  return document;
}

json description_json(const Catalogue::Entry<OptimizerFactory>& entry) {
  const auto& factory = entry.factory;
  const auto optimizer = plugins::create(entry, any_options(factory.options));
  const auto needs = plugins::needs(entry.plugin, *optimizer);
  json document = head(factory.type, factory.doc, factory.reference, entry.plugin);
  document["needs"] = {{"residuals", needs.residuals},
                       {"gradient", needs.gradient},
                       {"batch", needs.batch},
                       {"constraints", needs.constraints},
                       {"random", needs.random}};
  document["options"] = options_json(factory.options);
  return document;
}

json description_json(const Catalogue::Entry<MechanismFactory>& entry) {
  const auto& factory = entry.factory;
  json document = head(factory.id, factory.cause, factory.reference, entry.plugin);
  document["parameters"] = parameters_json(factory.parameters);
  document["null"] = factory.null;
  document["side"] = factory.side == MechanismFactory::Side::positive ? "positive"
                     : factory.side == MechanismFactory::Side::both   ? "both"
                                                                      : "even";
  document["plausible"] = {factory.plausible_min, factory.plausible_max};
  document["plausible_effect"] = factory.plausible_effect;
  document["directional"] = factory.directional;
  document["applies_to"] = factory.applies_to;
  document["look_alikes"] = factory.look_alikes;
  document["isolated_by"] = factory.isolated_by;
  document["options"] = options_json(factory.options);
  return document;
}

}  // namespace tunica::plugins
