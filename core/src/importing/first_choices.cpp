// SPDX-License-Identifier: Apache-2.0
#include "importing/first_choices.hpp"

#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/nearest.hpp"
#include "tunica/error.hpp"

namespace tunica::importing {

namespace {

template <class Known>
const auto& registered(const Known& known, const char* kind, const std::string& name) {
  if (const auto found = known.find(name); found != known.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [one, entry] : known) names.push_back(one);
  throw InputError(fmt::format("--{} {}: there is no such {}. {}", kind, name, kind, data::suggestion(name, names)));
}

}  // namespace

const TestFactory& chosen_test(const std::string& named, Specimen specimen, const plugins::Catalogue& catalogue) {
  if (!named.empty()) return registered(catalogue.tests(), "test", named).factory;
  if (const auto* const entry = catalogue.first_test(specimen)) return entry->factory;
  throw InputError("no loaded plugin provides a test that is the first choice for these columns. Name one with --test");
}

Json chosen_model(const std::string& named, Specimen specimen, const plugins::Catalogue& catalogue) {
  const auto* const entry =
      named.empty() ? catalogue.first_model(specimen) : &registered(catalogue.models(), "model", named);
  if (entry == nullptr)
    throw InputError(
        "no loaded plugin provides a model that is the first choice for these files. Name one with --model");
  Json model = {{"type", entry->factory.type}};
  for (const auto& [name, value] : entry->factory.first_choice.options)
    std::visit([&, &key = name](const auto& one) { model[key] = one; }, value);
  return {{entry->factory.type, std::move(model)}};
}

Json chosen_optimizer(const plugins::Catalogue& catalogue) {
  if (const auto* const refiner = catalogue.refiner())
    return {{"lm", {{"type", refiner->factory.type}, {"starts", 20}}}};
  throw InputError("no loaded plugin provides an optimizer that refines a fit. Give --plugin-path a folder with one");
}

}  // namespace tunica::importing
