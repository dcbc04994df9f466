// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "answer.hpp"
#include "data/nearest.hpp"
#include "exit_codes.hpp"
#include "plugins/description.hpp"
#include "plugins/guarded.hpp"
#include "text/wrapping.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

using text::hanging;

std::string text_of(const Option::Value& value) {
  return std::visit(
      [](const auto& content) -> std::string {
        if constexpr (std::is_same_v<std::decay_t<decltype(content)>, bool>)
          return content ? "true" : "false";
        else
          return fmt::format("{}", content);
      },
      value);
}

std::string kind_of(const Option& option) {
  switch (option.kind) {
    case Option::Kind::flag:
      return "true or false";
    case Option::Kind::integer:
      return "integer";
    case Option::Kind::number:
      return "number";
    case Option::Kind::quantity:
      return fmt::format("quantity in {}", option.unit);
    case Option::Kind::choice:
      return fmt::format("{}", fmt::join(option.choices, " | "));
    case Option::Kind::text:
      return "text";
    case Option::Kind::json:
      return "JSON";
  }
  return {};
}

void print_options(const std::vector<Option>& options, bool layered = false) {
  if (!options.empty() || layered) answer("\noptions\n");
  if (layered)
    answer("{}\n", hanging(fmt::format("  {:<18} ", "layers"),
                           "Layers of the wall from inside, each with a model of its own. (list of {\"model\": name, "
                           "\"thickness\": quantity in mm}; without it the model of the run fills the wall)"));
  for (const auto& option : options) {
    std::string text = kind_of(option);
    if (option.min) text += fmt::format(", at least {}", *option.min);
    if (option.max) text += fmt::format(", at most {}", *option.max);
    text += option.fallback ? fmt::format("; default {}", text_of(*option.fallback)) : std::string("; must be given");
    answer("{}\n", hanging(fmt::format("  {:<18} ", option.name), fmt::format("{} ({})", option.doc, text)));
  }
}

void print_parameters(const std::vector<Parameter>& parameters, const std::vector<double>& nulls = {}) {
  if (parameters.empty()) return;
  answer("\nparameters\n  {:<18} {:<8} {:>10} {:>10} {:>10}  scale\n", "name", "unit", "initial", "min", "max");
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& parameter = parameters[i];
    answer("  {:<18} {:<8} {:>10.6g} {:>10.6g} {:>10.6g}  {}\n", parameter.name, parameter.unit, parameter.initial,
           parameter.min, parameter.max, parameter.scale == Scale::log ? "log" : "linear");
    std::string text = parameter.doc;
    if (i < nulls.size() && !std::isnan(nulls[i]))
      text += fmt::format(" An imperfection: held at {} unless the experiment frees it.", nulls[i]);
    if (!parameter.reference.empty()) text += fmt::format(" [{}]", parameter.reference);
    if (!text.empty()) answer("{}\n", hanging("      ", text));
  }
}

void print_head(const std::string& kind, const std::string& name, const std::string& doc, const std::string& reference,
                const std::string& plugin) {
  answer("{} ({}, plugin {})\n{}\n", name, kind, plugin, hanging("  ", doc));
  if (!reference.empty()) answer("{}\n", hanging("  Reference: ", reference));
}

void print(const plugins::Catalogue::Entry<ModelFactory>& entry) {
  const auto& factory = entry.factory;
  print_head("model", factory.type, factory.doc, factory.reference, entry.plugin);
  const auto model = plugins::create(entry, plugins::any_options(factory.options));
  const auto& description = model->describe();
  if (!description.formula.empty()) answer("\n{}\n", hanging("energy: ", description.formula));
  print_parameters(description.parameters);
  print_options(factory.options);
  if (description.compressible)
    answer("\nchanges its volume: its stress is whole, and tests solve for their free faces\n");
  if (description.history_size > 0) answer("\nremembers its history: {} numbers a point\n", description.history_size);
  for (const auto& part : model->parts())
    answer("{}energy part: {}\n", part == model->parts().front() ? "\n" : "", part->describe().name);
}

void print(const plugins::Catalogue::Entry<TestFactory>& entry) {
  const auto& factory = entry.factory;
  print_head("test", factory.type, factory.doc, factory.reference, entry.plugin);
  answer("\nobservables that a data column can be mapped to\n");
  for (const auto& observable : factory.observables) {
    const char* role = observable.role == Observable::Role::abscissa ? "prescribed"
                       : observable.role == Observable::Role::time   ? "clock"
                                                                     : "measured";
    answer("{}\n", hanging(fmt::format("  {:<18} {:<8} ", observable.name, observable.unit),
                           fmt::format("{}{}. {}", role, observable.required ? ", required" : "", observable.doc)));
  }
  const auto own = plugins::parameters_of(entry);
  print_parameters(own.parameters, own.nulls);
  print_options(factory.options, factory.layered);
}

void print(const plugins::Catalogue::Entry<OptimizerFactory>& entry) {
  const auto& factory = entry.factory;
  print_head("optimizer", factory.type, factory.doc, factory.reference, entry.plugin);
  const auto optimizer = plugins::create(entry, plugins::any_options(factory.options));
  const auto needs = plugins::needs(entry.plugin, *optimizer);
  std::vector<std::string> words;
  if (needs.residuals) words.push_back("sees residuals");
  if (needs.gradient) words.push_back("uses derivatives");
  if (needs.constraints) words.push_back("handles constraints itself");
  if (needs.batch) words.push_back("evaluates populations in parallel");
  words.push_back(needs.random ? "depends on the seed" : "uses no random numbers");
  answer("{}\n", hanging("  ", fmt::format("{}.", fmt::join(words, "; "))));
  print_options(factory.options);
}

void print(const plugins::Catalogue::Entry<MechanismFactory>& entry) {
  const auto& factory = entry.factory;
  print_head("mechanism", factory.id, factory.cause, factory.reference, entry.plugin);
  print_parameters(factory.parameters);
  const char* side = factory.side == MechanismFactory::Side::positive ? "at or above it"
                     : factory.side == MechanismFactory::Side::both   ? "on both sides"
                                                                      : "on both sides, even";
  answer("\n  absent at {} = {}; acts {}; plausible from {} to {}\n",
         factory.parameters.empty() ? "amplitude" : factory.parameters.front().name, factory.null, side,
         factory.plausible_min, factory.plausible_max);
  if (factory.plausible_effect > 0)
    answer("  diagnosis: plausible up to an effect of {} times the range of the data\n", factory.plausible_effect);
  if (!factory.applies_to.empty()) answer("  applies to: {}\n", fmt::join(factory.applies_to, ", "));
  if (!factory.look_alikes.empty())
    answer("{}\n", hanging("  looks like: ", fmt::format("{}", fmt::join(factory.look_alikes, ", "))));
  if (!factory.isolated_by.empty()) answer("{}\n", hanging("  isolated by: ", factory.isolated_by));
  print_options(factory.options);
}

/// Prints the object of that name, or puts it into `document` under `kind`; false where the shelf has none.
template <class Shelf>
bool describe_if_there(const Shelf& shelf, const char* kind, const std::string& name, std::vector<std::string>& known,
                       nlohmann::ordered_json* document) {
  for (const auto& [key, entry] : shelf) known.push_back(key);
  const auto found = shelf.find(name);
  if (found == shelf.end()) return false;
  if (document)
    (*document)[kind] = plugins::description_json(found->second);
  else
    print(found->second);
  return true;
}

int describe(const GlobalOptions& global, const std::string& name, bool as_json) {
  const Session session(global);
  const auto& catalogue = session.catalogue();
  std::vector<std::string> known;
  nlohmann::ordered_json document;
  auto* const into = as_json ? &document : nullptr;
  bool found = describe_if_there(catalogue.models(), "model", name, known, into);
  found = describe_if_there(catalogue.tests(), "test", name, known, into) || found;
  found = describe_if_there(catalogue.optimizers(), "optimizer", name, known, into) || found;
  found = describe_if_there(catalogue.mechanisms(), "mechanism", name, known, into) || found;
  if (!found) throw InputError(fmt::format("nothing is called '{}'. {}", name, data::suggestion(name, known)));
  if (as_json) print_json(document);
  return done;
}

}  // namespace

void add_describe(CLI::App& app, GlobalOptions& global, Action& action) {
  auto name = std::make_shared<std::string>();
  auto as_json = std::make_shared<bool>(false);
  auto* verb = app.add_subcommand("describe", "Describe a model, test, optimizer or mechanism");
  verb->add_option("name", *name, "Name as `tunica list` shows it")->required()->type_name("NAME");
  verb->add_flag("--json", *as_json, "Print one JSON object, whose key is the kind of what is described");
  verb->footer(
      "Examples:\n  tunica describe gho\n  tunica describe uniaxial\n  tunica describe ceres_lm\n"
      "  tunica describe gho --json | jq '.model.parameters[].name'");
  verb->callback([&global, &action, name, as_json] {
    action = [&global, name, as_json] { return describe(global, *name, *as_json); };
  });
}

}  // namespace tunica::app
