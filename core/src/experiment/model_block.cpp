// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <exception>
#include <memory>
#include <new>

#include <fmt/format.h>

#include "experiment/blocks.hpp"
#include "experiment/materials.hpp"
#include "plugins/guarded.hpp"

namespace tunica::experiment {
namespace {

using ModelInCatalogue = plugins::Catalogue::Entry<ModelFactory>;

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

bool declares(const std::vector<Option>& options, std::string_view name) {
  return std::any_of(options.begin(), options.end(), [&](const Option& option) { return option.name == name; });
}

/// What the material is; a key of every model that has no option of this name.
Key<ModelEntry> material_of_model() {
  return {material_key,
          [] {
            return choice_schema(
                "What it is: measured stiffness far from published ones of this material is worth a question of units.",
                known_materials());
          },
          [](const Node& node, ModelEntry& model) {
            model.options.set(material_key, node.one_of(known_materials(), "material"));
          },
          [](const ModelEntry& model) {
            return model.options.has(material_key) ? Json(model.options.text(material_key)) : Json();
          }};
}

Block<ModelEntry> model_block(const std::string& owner, const std::string& doc, const ModelInCatalogue& available,
                              const plugins::Catalogue& catalogue) {
  const ModelFactory& factory = available.factory;
  std::vector<Key<ModelEntry>> keys = keys_of_plugin<ModelEntry>(factory.type, factory.options);
  if (!declares(factory.options, material_key)) keys.insert(keys.begin() + 1, material_of_model());
  const auto parameters = [&available] {
    Json schema = parameters_schema(possible_parameters(available));
    const auto names_parameters = [](const Option& option) { return option.kind == Option::Kind::json; };
    const auto& options = available.factory.options;
    if (std::any_of(options.begin(), options.end(), names_parameters))
      schema["additionalProperties"] = reference("parameter");
    return schema;
  };
  keys.push_back(
      {"parameters", parameters, {}, [](const ModelEntry& model) { return write_parameters(model.parameters); }});
  keys.push_back({"mechanisms",
                  [&catalogue] { return model_mechanisms_schema(catalogue); },
                  {},
                  [&catalogue](const ModelEntry& model) { return write_mechanisms(model.mechanisms, catalogue); }});
  return {owner, doc, std::move(keys)};
}

/// Wraps the model in its mechanisms as a run will, in canonical order, so that a mechanism that cannot apply (for want
/// of fibres, say) is refused here, with its place.
void try_mechanisms(const Node& entry, std::unique_ptr<Model> model, const std::vector<MechanismEntry>& mechanisms,
                    const plugins::Catalogue& catalogue) {
  std::vector<std::size_t> order(mechanisms.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto stage = [&](std::size_t i) {
    return catalogue.mechanisms().find(mechanisms[i].type)->second.factory.stage;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return stage(a) < stage(b); });
  for (const std::size_t i : order) {
    try {
      model = plugins::wrap(catalogue.mechanisms().find(mechanisms[i].type)->second, std::move(model),
                            mechanisms[i].options);
    } catch (const InputError& error) {
      entry.require("mechanisms", "")
          .element(i)
          .fail(fmt::format("the mechanism '{}' cannot act on this model", mechanisms[i].type), error.what());
    }
  }
}

}  // namespace

ModelEntry read_model(const std::string& name, const Node& entry, const plugins::Catalogue& catalogue,
                      std::vector<SharedParameter>& shared) {
  entry.expect_object("a model, {\"type\": …},");
  entry.check_name(name, "model");
  const std::string owner = fmt::format("model '{}'", name);
  const std::string type = entry.require("type", owner).one_of(names_of(catalogue.models()), "model type");
  const ModelInCatalogue& available = catalogue.models().find(type)->second;
  const Block<ModelEntry> block = model_block(owner, "", available, catalogue);
  block.allow_only(entry);
  ModelEntry model{name, type, default_options(entry, available.factory.options, owner), {}, {}};
  block.read(entry, model);
  std::unique_ptr<Model> instance;
  try {
    instance = plugins::create(available, model.options);
  } catch (const InputError& error) {
    entry.fail(fmt::format("{} is refused", owner), error.what());
  }
  const std::vector<Parameter> parameters = instance->describe().parameters;
  model.findings = bare_angles(entry, available.factory.options, parameters, owner);
  model.parameters = read_parameters(entry, parameters, owner, shared);
  model.mechanisms = read_model_mechanisms(entry, owner, catalogue, shared, model.findings);
  try_mechanisms(entry, std::move(instance), model.mechanisms, catalogue);
  return model;
}

Json write_model(const ModelEntry& entry, const plugins::Catalogue& catalogue) {
  return model_block("", "", catalogue.models().find(entry.type)->second, catalogue).write(entry);
}

void define_models(Json& definitions, const plugins::Catalogue& catalogue) {
  for (const auto& [type, entry] : catalogue.models())
    definitions["model_" + type] =
        model_block("", described(entry.factory.doc, entry.factory.reference, entry.plugin), entry, catalogue).schema();
}

}  // namespace tunica::experiment
