// SPDX-License-Identifier: Apache-2.0
#include "assembly/composition.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cards/card.hpp"
#include "data/nearest.hpp"
#include "data/units.hpp"
#include "plugins/calls.hpp"
#include "plugins/default_options.hpp"
#include "plugins/guarded.hpp"
#include "plugins/interrupted.hpp"

namespace tunica::assembly {
namespace {

using experiment::MechanismEntry;
using experiment::ParameterSettings;
using MechanismOnShelf = plugins::Catalogue::Entry<MechanismFactory>;

template <class Shelf>
const typename Shelf::mapped_type& look_up(const Shelf& shelf, const std::string& type, const std::string& what) {
  const auto found = shelf.find(type);
  if (found == shelf.end()) {
    std::vector<std::string> known;
    for (const auto& [name, entry] : shelf) known.push_back(name);
    throw InputError(
        fmt::format("no loaded plugin provides the {} '{}'. {}", what, type, data::suggestion(type, known)));
  }
  return found->second;
}

struct Layer {
  const MechanismEntry* entry;
  const MechanismOnShelf* mechanism;
};

/// The mechanisms of one model or test from the inside out.
std::vector<Layer> layers(const std::vector<MechanismEntry>& entries, const plugins::Catalogue& catalogue,
                          const std::string& owner, bool on_model) {
  std::vector<Layer> found;
  std::set<std::string> seen;
  for (const MechanismEntry& entry : entries) {
    const MechanismOnShelf& mechanism = look_up(catalogue.mechanisms(), entry.type, "mechanism");
    if (!seen.insert(entry.name()).second) {
      throw InputError(
          fmt::format("{}: the mechanism '{}' is listed twice, so its parameters would share their names; "
                      "keep one, or name one of them with \"as\"",
                      owner, entry.name()));
    }
    const bool acts_on_model = mechanism.factory.stage < Stage::test;
    if (acts_on_model != on_model) {
      throw InputError(fmt::format("{}: the mechanism '{}' acts on a {}; list it under the mechanisms of a {}", owner,
                                   entry.type, acts_on_model ? "model" : "test", acts_on_model ? "model" : "test"));
    }
    found.push_back({&entry, &mechanism});
  }
  std::stable_sort(found.begin(), found.end(), [](const Layer& a, const Layer& b) {
    const MechanismFactory &one = a.mechanism->factory, &other = b.mechanism->factory;
    return std::pair(one.stage, one.memory) < std::pair(other.stage, other.memory);
  });
  return found;
}

const experiment::ParameterSetting* setting_of(const ParameterSettings& settings, const std::string& name) {
  const auto found = settings.find(name);
  return found == settings.end() ? nullptr : &found->second;
}

std::vector<Slot> own_slots(const std::vector<Parameter>& parameters, const ParameterSettings& settings,
                            const ParameterId& entry, const std::string& prefix, const std::string& owner) {
  std::vector<Slot> slots;
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters) {
    names.push_back(parameter.name);
    slots.push_back({parameter, setting_of(settings, parameter.name)});
    slots.back().declaration.name = prefix + parameter.name;
    slots.back().id = {entry.kind, entry.owner, "", parameter.name};
  }
  refuse_unknown(settings, names, owner);
  return slots;
}

/// Appends to `slots` the parameters that `layer` adds, as the decorator declares them.
void append_slots(std::vector<Slot>& slots, const std::vector<Parameter>& decorated, const Layer& layer,
                  const ParameterId& entry, const std::string& prefix, const std::string& owner) {
  const auto declared = layer.mechanism->factory.parameters_with(layer.entry->options);
  if (decorated.size() != slots.size() + declared.size()) {
    throw plugins::PluginFailure(fmt::format(
        "plugin '{}': the mechanism '{}' declares {} parameters, but its decorator has {} behind the {} it wraps",
        layer.mechanism->plugin, layer.entry->type, declared.size(),
        static_cast<std::ptrdiff_t>(decorated.size()) - static_cast<std::ptrdiff_t>(slots.size()), slots.size()));
  }
  std::vector<std::string> names;
  const std::size_t first = slots.size();
  for (std::size_t k = 0; k < declared.size(); ++k) {
    names.push_back(declared[k].name);
    slots.push_back({decorated[first + k], setting_of(layer.entry->parameters, declared[k].name)});
    slots.back().declaration.name = fmt::format("{}{}.{}", prefix, layer.entry->name(), declared[k].name);
    slots.back().id = {entry.kind, entry.owner, layer.entry->name(), declared[k].name};
  }
  refuse_unknown(layer.entry->parameters, names, fmt::format("mechanism '{}' of {}", layer.entry->name(), owner));
}

/// Parameters that tests of this type can have, but that a test with these options lacks.
void refuse_excluded(const experiment::TestEntry& entry, const std::vector<Parameter>& of_type,
                     const std::vector<Parameter>& of_test, const std::string& owner) {
  const auto among = [](const std::vector<Parameter>& parameters, const std::string& name) {
    return std::any_of(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.name == name; });
  };
  for (const auto& [name, setting] : entry.parameters)
    if (among(of_type, name) && !among(of_test, name))
      throw InputError(fmt::format("{}: the parameter '{}' means nothing in {} {}; leave one of them out",
                                   setting.pointer, name, owner,
                                   entry.layers.empty() ? "with these options" : "with \"layers\""));
}

void refuse_other_tests(const experiment::TestEntry& entry, const Layer& layer, const std::string& owner) {
  const auto& applies_to = layer.mechanism->factory.applies_to;
  if (applies_to.empty() || std::find(applies_to.begin(), applies_to.end(), entry.type) != applies_to.end()) return;
  throw InputError(
      fmt::format("{}: the mechanism '{}' does not apply to a test of type '{}'; take it out, or put it into a test "
                  "that it applies to: {}",
                  owner, layer.entry->type, entry.type, fmt::join(applies_to, ", ")));
}

/// TestSetup::card for a model of the experiment.
auto card_writer(const experiment::ModelEntry& entry, const plugins::Catalogue& catalogue) {
  std::vector<cards::Ingredient> mechanisms;
  for (const MechanismEntry& mechanism : entry.mechanisms) mechanisms.push_back({mechanism.type, mechanism.options});
  return [model = cards::Ingredient{entry.type, entry.options}, mechanisms, &catalogue](
             const Model&, std::span<const double> values, const CardRequest& request) {
    return cards::write_card(cards::target_of(request.program),
                             cards::material_of(catalogue, model, mechanisms, values),
                             {.name = request.material, .units = cards::unit_system(request.units)});
  };
}

/// The options of the test that mechanisms for native imperfections set. A default of a mechanism does not override the
/// test's own entry.
void override_options(Options& options, const std::vector<Option>& of_test, const std::vector<Layer>& mechanisms) {
  const auto is_default = [](const std::vector<Option>& declared, const std::string& name, const Option::Value& value) {
    return std::any_of(declared.begin(), declared.end(), [&](const Option& option) {
      return option.name == name && option.fallback == std::optional(value);
    });
  };
  for (const Layer& layer : mechanisms) {
    const MechanismFactory& factory = layer.mechanism->factory;
    for (const auto& [name, value] : layer.entry->options.values()) {
      if (factory.native.empty() || !options.has(name)) continue;
      const Option::Value& own = options.values().find(name)->second;
      if (!is_default(factory.options, name, value) || is_default(of_test, name, own)) options.set(name, value);
    }
  }
}

/// Hands the test's native parameters to the mechanism that frees them: under the mechanism's names, and free unless
/// fixed. Its nuisance parameters are those of the test whose names begin with the name of the native parameter.
void expose_native(std::vector<Slot>& slots, const std::vector<Parameter>& of_test, const Layer& layer,
                   const experiment::TestEntry& entry, const std::string& prefix, const std::string& owner) {
  const MechanismFactory& factory = layer.mechanism->factory;
  std::vector<std::string> names;
  for (const Parameter& parameter : factory.parameters) {
    const std::string native = names.empty() ? factory.native : factory.native + "_" + parameter.name;
    const auto found = std::ranges::find(of_test, native, &Parameter::name);
    if (found == of_test.end())
      throw InputError(fmt::format(
          "{}: the mechanism '{}' is the test's own parameter '{}', which it does not have {}; take the mechanism out",
          owner, factory.id, native, entry.layers.empty() ? "with these options" : "with \"layers\""));
    Slot& slot = slots[static_cast<std::size_t>(found - of_test.begin())];
    if (slot.setting)
      throw InputError(fmt::format("{}: the mechanism '{}' is the parameter '{}' of {}; name one of the two",
                                   slot.setting->pointer, factory.id, native, owner));
    slot.declaration.name = fmt::format("{}{}.{}", prefix, layer.entry->name(), parameter.name);
    slot.id.mechanism = layer.entry->name();
    slot.id.name = parameter.name;
    slot.setting = setting_of(layer.entry->parameters, parameter.name);
    slot.null = std::numeric_limits<double>::quiet_NaN();
    names.push_back(parameter.name);
  }
  refuse_unknown(layer.entry->parameters, names, fmt::format("mechanism '{}' of {}", factory.id, owner));
}

}  // namespace

ComposedModel compose_model(const experiment::ModelEntry& entry, const plugins::Catalogue& catalogue,
                            const std::string& prefix) {
  const std::string owner = fmt::format("model '{}'", entry.name);
  const auto& on_shelf = look_up(catalogue.models(), entry.type, "model type");
  ComposedModel composed{plugins::create(on_shelf, entry.options), on_shelf.plugin, {}};
  const ParameterId id = of_model(entry.name, "", "");
  composed.slots = own_slots(composed.model->describe().parameters, entry.parameters, id, prefix, owner);
  for (const Layer& layer : layers(entry.mechanisms, catalogue, owner, true)) {
    composed.model = plugins::wrap(*layer.mechanism, std::move(composed.model), layer.entry->options);
    append_slots(composed.slots, composed.model->describe().parameters, layer, id, prefix, owner);
  }
  return composed;
}

ComposedTest compose_test(const experiment::TestEntry& entry, const plugins::Catalogue& catalogue,
                          const experiment::ModelEntry* model) {
  const std::string owner = fmt::format("test '{}'", entry.name), prefix = entry.name + ".";
  const auto& on_shelf = look_up(catalogue.tests(), entry.type, "test type");
  ComposedTest composed{{}, on_shelf.plugin, {}, {}};
  Options of_test = entry.options;
  const std::vector<Layer> mechanisms = layers(entry.mechanisms, catalogue, owner, false);
  for (const Layer& layer : mechanisms) refuse_other_tests(entry, layer, owner);
  try {
    composed.dataset = data::read_dataset(entry.data, on_shelf.factory.observables);
    override_options(of_test, on_shelf.factory.options, mechanisms);
    TestSetup setup{of_test, composed.dataset.rows(), entry.data.stress_measure};
    for (const experiment::LayerEntry& one : entry.layers) setup.layers.push_back(one.thickness);
    for (const data::Channel& channel : composed.dataset.channels) setup.measured.emplace_back(channel.values);
    setup.folder = entry.folder.string();
    if (model != nullptr) setup.card = card_writer(*model, catalogue);
    setup.unit_factor = [](std::string_view from, std::string_view to) { return data::convert(1, from, to); };
    setup.interrupted = [] {
      return plugins::interrupted.load() || plugins::Clock::now() >= plugins::deadline_of_this_thread();
    };
    composed.test = plugins::create(on_shelf, setup);
  } catch (const InputError& problem) {
    throw InputError(fmt::format("{}: {}", owner, problem.what()));
  }
  const TestDescription& bare = composed.test->describe();
  refuse_excluded(entry, on_shelf.factory.parameters, bare.parameters, owner);
  const ParameterId id = assembly::of_test(entry.name, "", "");
  composed.slots = own_slots(bare.parameters, entry.parameters, id, prefix, owner);
  for (std::size_t k = 0; k < std::min(bare.nulls.size(), composed.slots.size()); ++k)
    composed.slots[k].null = bare.nulls[k];
  const std::vector<Parameter> own = bare.parameters;
  for (const Layer& layer : mechanisms) {
    if (!layer.mechanism->factory.native.empty()) {
      expose_native(composed.slots, own, layer, entry, prefix, owner);
      continue;
    }
    composed.test = plugins::wrap(*layer.mechanism, std::move(composed.test),
                                  plugins::with_options_of_test(layer.entry->options, of_test));
    append_slots(composed.slots, composed.test->describe().parameters, layer, id, prefix, owner);
  }
  const TestRows& rows = composed.test->rows();
  if (rows.count != composed.dataset.count || rows.channels.size() != composed.dataset.channels.size()) {
    throw plugins::PluginFailure(fmt::format("plugin '{}': {} was given {} rows of {} channels and reports {} of {}",
                                             composed.plugin, owner, composed.dataset.count,
                                             composed.dataset.channels.size(), rows.count, rows.channels.size()));
  }
  return composed;
}

}  // namespace tunica::assembly
