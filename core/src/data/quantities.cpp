// SPDX-License-Identifier: Apache-2.0
#include "data/quantities.hpp"

#include <algorithm>

namespace tunica::data {
namespace {

using From = Quantity::Kind;

constexpr std::string_view stretch_word = "stretch", stress_word = "stress", shear_word = "shear";

/// "stress_axial" with "force" for "stress"; empty where the word does not stand alone between underscores.
std::string replaced(std::string_view name, std::string_view word, std::string_view by) {
  const std::size_t at = name.find(word);
  if (at == std::string_view::npos) return {};
  const std::size_t end = at + word.size();
  if ((at > 0 && name[at - 1] != '_') || (end < name.size() && name[end] != '_')) return {};
  return std::string(name.substr(0, at)) + std::string(by) + std::string(name.substr(end));
}

}  // namespace

std::string direction_of(std::string_view observable) {
  for (const std::string_view word : {stretch_word, stress_word}) {
    std::string rest = replaced(observable, word, "");
    if (rest.empty()) continue;
    return rest.front() == '_' ? rest.substr(1) : rest.back() == '_' ? rest.substr(0, rest.size() - 1) : rest;
  }
  return {};
}

static bool is_shear(const Observable& observable) {
  return observable.name == shear_word && observable.role == Observable::Role::abscissa && observable.unit == "1";
}

bool shears(const std::vector<Observable>& observables) {
  return std::any_of(observables.begin(), observables.end(), is_shear);
}

std::vector<RawName> raw_names(const std::vector<Observable>& observables) {
  std::vector<RawName> names;
  const auto add = [&](const Observable& of, std::string_view word, std::string_view by, From kind, const char* unit) {
    std::string name = replaced(of.name, word, by);
    const bool taken = std::any_of(observables.begin(), observables.end(),
                                   [&](const Observable& observable) { return observable.name == name; });
    if (!name.empty() && !taken) names.push_back({std::move(name), {&of, kind, unit}});
  };
  const bool plates = shears(observables);
  for (const Observable& observable : observables) {
    if (is_shear(observable)) add(observable, shear_word, "shear_displacement", From::shear_displacement, "mm");
    if (plates && observable.role == Observable::Role::channel && observable.kind == Observable::Kind::plain &&
        observable.unit == "kPa")
      add(observable, stress_word, "force", From::plate_force, "mN");
    if (observable.kind == Observable::Kind::stretch && observable.role == Observable::Role::abscissa) {
      add(observable, stretch_word, "displacement", From::displacement, "mm");
      add(observable, stretch_word, "length", From::length, "mm");
      add(observable, stretch_word, "strain", From::strain, "1");
      add(observable, stretch_word, "true_strain", From::true_strain, "1");
      add(observable, stretch_word, "green_strain", From::green_strain, "1");
    }
    if (observable.kind == Observable::Kind::stretch && observable.role == Observable::Role::channel) {
      // The grips give the stretch along a strip under a load; the machine does not measure stretches across it.
      if (observable.name == stretch_word) {
        add(observable, stretch_word, "displacement", From::displacement, "mm");
        add(observable, stretch_word, "length", From::length, "mm");
      }
      add(observable, stretch_word, "strain", From::strain, "1");
      add(observable, stretch_word, "true_strain", From::true_strain, "1");
    }
    if (observable.kind == Observable::Kind::stress) add(observable, stress_word, "force", From::force, "mN");
  }
  return names;
}

std::optional<Quantity> quantity_named(std::string_view name, const std::vector<Observable>& observables) {
  for (const Observable& observable : observables)
    if (observable.name == name) return Quantity{&observable, From::own, observable.unit};
  for (RawName& raw : raw_names(observables))
    if (raw.name == name) return std::move(raw.quantity);
  return std::nullopt;
}

Sizes sizes_along(const Specimen& specimen, std::string_view observable) {
  Sizes sizes = specimen.all;
  const std::string direction = direction_of(observable);
  for (const auto& [name, own] : specimen.directions) {
    if (name != direction) continue;
    if (own.width) sizes.width = own.width;
    if (own.gauge_length) sizes.gauge_length = own.gauge_length;
    if (own.grip_distance) sizes.grip_distance = own.grip_distance;
  }
  return sizes;
}

std::vector<std::string> directions_of(const std::vector<Observable>& observables) {
  std::vector<std::string> directions;
  for (const RawName& raw : raw_names(observables)) {
    const std::string direction = direction_of(raw.quantity.observable->name);
    if (!direction.empty() && std::find(directions.begin(), directions.end(), direction) == directions.end())
      directions.push_back(direction);
  }
  return directions;
}

bool is_signed(const Quantity& quantity) {
  if (quantity.kind == From::own) return quantity.observable->kind == Observable::Kind::stress;
  return quantity.kind != From::length;
}

const Observable* stretch_beside(const Observable& stress, const std::vector<Observable>& observables) {
  const std::string wanted = replaced(stress.name, stress_word, stretch_word);
  for (const Observable& observable : observables)
    if (observable.name == wanted && observable.role == Observable::Role::abscissa) return &observable;
  return nullptr;
}

}  // namespace tunica::data
