// SPDX-License-Identifier: Apache-2.0
#include "plugins/description.hpp"

#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "plugins/guarded.hpp"
#include "results/keys.hpp"
#include "tunica/error.hpp"

namespace tunica::plugins {

namespace key = results::key;

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
  return {{key::name, name}, {key::doc, doc}, {key::reference, reference}, {key::plugin, plugin}};
}

json options_json(const std::vector<Option>& options) {
  json list = json::array();
  for (const auto& option : options) {
    json one = {
        {key::name, option.name}, {key::kind, word_of(option.kind)}, {key::required, !option.fallback.has_value()}};
    if (option.fallback) std::visit([&](const auto& value) { one[key::default_] = value; }, *option.fallback);
    if (!option.unit.empty()) one[key::unit] = option.unit;
    if (option.min) one[key::min] = *option.min;
    if (option.max) one[key::max] = *option.max;
    if (!option.choices.empty()) one[key::choices] = option.choices;
    one[key::doc] = option.doc;
    list.push_back(std::move(one));
  }
  return list;
}

json parameters_json(const std::vector<Parameter>& parameters, const std::vector<double>& nulls = {}) {
  json list = json::array();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& parameter = parameters[i];
    json one = {{key::name, parameter.name},       {key::unit, parameter.unit},
                {key::initial, parameter.initial}, {key::min, parameter.min},
                {key::max, parameter.max},         {key::scale, parameter.scale == Scale::log ? "log" : "linear"}};
    if (i < nulls.size() && !std::isnan(nulls[i])) one[key::held_at] = nulls[i];
    one[key::doc] = parameter.doc;
    one[key::reference] = parameter.reference;
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
  document[key::parameters] = parameters_json(model->describe().parameters);
  document[key::options] = options_json(factory.options);
  if (!model->describe().formula.empty()) document[key::formula] = model->describe().formula;
  document[key::compressible] = model->describe().compressible;
  document[key::history_size] = model->describe().history_size;
  document[key::energy_parts] = json::array();
  for (const auto& part : model->parts()) document[key::energy_parts].push_back(part->describe().name);
  return document;
}

json description_json(const Catalogue::Entry<TestFactory>& entry) {
  const auto& factory = entry.factory;
  json document = head(factory.type, factory.doc, factory.reference, entry.plugin);
  document[key::observables] = json::array();
  for (const auto& observable : factory.observables)
    document[key::observables].push_back({{key::name, observable.name},
                                          {key::unit, observable.unit},
                                          {key::role, observable.role == Observable::Role::abscissa ? "prescribed"
                                                      : observable.role == Observable::Role::time   ? "clock"
                                                                                                    : "measured"},
                                          {key::required, observable.required},
                                          {key::doc, observable.doc}});
  const auto own = parameters_of(entry);
  document[key::parameters] = parameters_json(own.parameters, own.nulls);
  document[key::options] = options_json(factory.options);
  document[key::layers] = factory.layered;
  return document;
}

json description_json(const Catalogue::Entry<OptimizerFactory>& entry) {
  const auto& factory = entry.factory;
  const auto optimizer = plugins::create(entry, any_options(factory.options));
  const auto needs = plugins::needs(entry.plugin, *optimizer);
  json document = head(factory.type, factory.doc, factory.reference, entry.plugin);
  document[key::needs] = {{key::residuals, needs.residuals},
                          {key::gradient, needs.gradient},
                          {key::batch, needs.batch},
                          {key::constraints, needs.constraints},
                          {key::random, needs.random}};
  document[key::options] = options_json(factory.options);
  return document;
}

json description_json(const Catalogue::Entry<MechanismFactory>& entry) {
  const auto& factory = entry.factory;
  json document = head(factory.id, factory.cause, factory.reference, entry.plugin);
  document[key::parameters] = parameters_json(factory.parameters);
  document[key::null] = factory.null;
  document[key::side] = factory.side == MechanismFactory::Side::positive ? "positive"
                        : factory.side == MechanismFactory::Side::both   ? "both"
                                                                         : "even";
  document[key::plausible] = {factory.plausible_min, factory.plausible_max};
  document[key::plausible_effect] = factory.plausible_effect;
  document[key::directional] = factory.directional;
  document[key::applies_to] = factory.applies_to;
  document[key::look_alikes] = factory.look_alikes;
  document[key::isolated_by] = factory.isolated_by;
  document[key::options] = options_json(factory.options);
  return document;
}

}  // namespace tunica::plugins
