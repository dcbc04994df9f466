// SPDX-License-Identifier: Apache-2.0
#include "plugins/catalogue.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "plugins/declared_bounds.hpp"
#include "tunica/error.hpp"

namespace tunica::plugins {
namespace {

bool is_letter(char character) {
  return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z');
}

/// Names become JSON keys and parts of dotted parameter names, so a dot or a blank in one would be ambiguous.
bool is_plain_identifier(std::string_view name) {
  return !name.empty() && is_letter(name.front()) && std::ranges::all_of(name, [](char character) {
    return is_letter(character) || (character >= '0' && character <= '9') || character == '_';
  });
}

/// By name: the order of loading therefore does not matter.
template <class Entries, class Predicate>
const typename Entries::mapped_type* first_with(const Entries& entries, Predicate has_role) {
  for (const auto& [name, entry] : entries)
    if (has_role(entry.factory)) return &entry;
  return nullptr;
}

template <class Factory>
const std::string& name_of(const Factory& factory) {
  return factory.type;
}
const std::string& name_of(const MechanismFactory& factory) { return factory.id; }

template <class Factory>
void check_callable(const Factory& factory, std::string_view kind) {
  if (!factory.create) {
    throw std::invalid_argument(
        fmt::format("the {} '{}' has no create function; set it before registering", kind, name_of(factory)));
  }
}
void check_callable(const MechanismFactory& factory, std::string_view kind) {
  const bool on_model = factory.stage < tunica::Stage::test;
  if (!factory.native.empty()) {
    if (!on_model && !factory.wrap_model && !factory.wrap_test && !factory.parameters.empty()) return;
    throw std::invalid_argument(
        fmt::format("the {} '{}' stands for a test's own parameter '{}'; such a mechanism acts at stage 'test', wraps "
                    "nothing and has that parameter first; correct its factory before registering",
                    kind, factory.id, factory.native));
  }
  if (on_model ? !factory.wrap_model : !factory.wrap_test) {
    throw std::invalid_argument(
        fmt::format("the {} '{}' has no {} function, which its stage needs; set it before "
                    "registering",
                    kind, factory.id, on_model ? "wrap_model" : "wrap_test"));
  }
}

template <class Factory>
std::string flaw_of_parameters(const Factory&) {
  return {};  // those of a model are known once it is made, see check_when_made()
}
std::string flaw_of_parameters(const TestFactory& factory) { return first_flaw(factory.parameters); }
std::string flaw_of_parameters(const MechanismFactory& factory) { return first_flaw(factory.parameters); }

template <class Factory>
void check_defaults(const Factory& factory, std::string_view kind) {
  std::string flaw = first_flaw(factory.options);
  if (flaw.empty()) flaw = flaw_of_parameters(factory);
  if (!flaw.empty())
    throw std::invalid_argument(fmt::format("the {} '{}': {}; correct the declaration", kind, name_of(factory), flaw));
}

/// A model tells its parameters once it is made, with whatever options: then they are checked.
template <class Factory>
void check_when_made(Factory&) {}
void check_when_made(ModelFactory& factory) {
  factory.create = [make = std::move(factory.create), type = factory.type](const Options& options) {
    std::unique_ptr<Model> model = make(options);
    if (model)
      if (const std::string flaw = first_flaw(model->describe().parameters); !flaw.empty())
        throw InputError(fmt::format("the model '{}': {}; correct the declaration", type, flaw));
    return model;
  };
}

/// Checks the registrations of one plugin against the existing ones; merging the result cannot fail.
template <class Factory>
Catalogue::Entries<Factory> checked_entries(std::vector<Factory>&& factories, const Catalogue::Entries<Factory>& taken,
                                            const std::string& plugin, std::string_view kind) {
  Catalogue::Entries<Factory> entries;
  for (Factory& factory : factories) {
    const std::string name = name_of(factory);
    if (!is_plain_identifier(name)) {
      throw std::invalid_argument(fmt::format(
          "the {} name '{}' is not a plain identifier; expected letters, digits and underscores, with a letter first",
          kind, name));
    }
    check_callable(factory, kind);
    check_defaults(factory, kind);
    if (const auto found = taken.find(name); found != taken.end()) {
      throw std::invalid_argument(
          fmt::format("the {} '{}' is already provided by plugin '{}', and names must be "
                      "unique; rename it, or leave one of the two plugins out of the plugin path",
                      kind, name, found->second.plugin));
    }
    check_when_made(factory);
    if (!entries.emplace(name, Catalogue::Entry<Factory>{std::move(factory), plugin}).second) {
      throw std::invalid_argument(
          fmt::format("the plugin registers the {} '{}' twice; rename one of them", kind, name));
    }
  }
  return entries;
}

}  // namespace

void Catalogue::commit(Registration&& registration, const std::string& plugin) {
  auto models = checked_entries(std::move(registration.models), models_, plugin, "model");
  auto tests = checked_entries(std::move(registration.tests), tests_, plugin, "test");
  auto optimizers = checked_entries(std::move(registration.optimizers), optimizers_, plugin, "optimiser");
  auto mechanisms = checked_entries(std::move(registration.mechanisms), mechanisms_, plugin, "mechanism");
  // Nodes change hands without allocating: from here on nothing can fail, so it is all or nothing.
  models_.merge(models);
  tests_.merge(tests);
  optimizers_.merge(optimizers);
  mechanisms_.merge(mechanisms);
}

const Catalogue::Entry<ModelFactory>* Catalogue::term_model() const {
  return first_with(models_, [](const ModelFactory& model) { return model.writes_terms; });
}

const Catalogue::Entry<MechanismFactory>* Catalogue::term_mechanism() const {
  return first_with(mechanisms_, [](const MechanismFactory& mechanism) { return mechanism.writes_terms; });
}

const Catalogue::Entry<OptimizerFactory>* Catalogue::refiner() const {
  return first_with(optimizers_, [](const OptimizerFactory& optimizer) { return optimizer.refines; });
}

const Catalogue::Entry<TestFactory>* Catalogue::first_test(Specimen specimen) const {
  return first_with(tests_, [&](const TestFactory& test) { return test.first_choice && test.specimen == specimen; });
}

const Catalogue::Entry<ModelFactory>* Catalogue::first_model(Specimen specimen) const {
  return first_with(models_, [&](const ModelFactory& model) {
    const auto& claimed = model.first_choice.specimens;
    return std::find(claimed.begin(), claimed.end(), specimen) != claimed.end();
  });
}

}  // namespace tunica::plugins
