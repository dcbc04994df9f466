// SPDX-License-Identifier: Apache-2.0
#include "added_term.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "energy.hpp"
#include "tunica/error.hpp"
#include "tunica/models/decorated_model.hpp"
#include "tunica/models/model_sum.hpp"
#include "volume_laws.hpp"

namespace tunica::composed {

namespace {

using Json = nlohmann::ordered_json;

/// The options as the only entry of a list of terms. A default is ignored if it does not apply.
std::string list_of(const Options& options) {
  Json term = {{"name", "term"}, {"invariant", options.text("invariant")}};
  if (!options.text("invariant").starts_with("stretches")) term["law"] = options.text("law");
  if (options.text("invariant").starts_with("fibre"))
    for (const char* key : {"family", "dispersion", "fibre_switch"}) term[key] = options.text(key);
  if (options.text("law") == "spline") term["knots"] = Json::parse(options.text("knots"));
  return Json::array({term}).dump();
}

/// As a model of its own calls them, without the name of the term. The first is the amplitude, which may be nothing.
std::vector<Parameter> own_parameters(const Model& term) {
  const std::size_t prefix = std::string("term_").size();
  std::vector<Parameter> parameters = term.describe().parameters;
  for (Parameter& parameter : parameters) parameter.name.erase(0, prefix);
  Parameter& amplitude = parameters.front();
  if (amplitude.min > 0) amplitude.min = 0;
  amplitude.scale = Scale::linear;
  return parameters;
}

std::unique_ptr<Model> wrapped(std::unique_ptr<Model> base, const Options& options) {
  const std::vector<Term> terms = read_terms(list_of(options));
  std::unique_ptr<Model> added = energy_of(terms);
  std::vector<Parameter> own = own_parameters(*added);
  // A curve has a height at every knot: none of them alone switches it off.
  const double null = terms.front().law.name == "spline" ? std::numeric_limits<double>::quiet_NaN() : 0;
  if (added->describe().compressible && !base->describe().compressible)
    throw InputError(fmt::format(
        "added_term: the invariant '{}' is of materials that change their volume, and the model '{}' keeps it. Take "
        "another invariant, or a model that is compressible by itself.",
        options.text("invariant"), base->describe().type));
  const std::shared_ptr<const Model> shared(std::move(base));
  if (shared->parts().empty() || added->parts().empty())
    return std::make_unique<ModelSum>(shared, std::move(own), null, std::move(added));
  EnergyParts parts;
  for (const auto& part : shared->parts()) parts.push_back(std::make_unique<ForwardedPart>(shared, *part));
  const std::shared_ptr<const Model> owner(std::move(added));
  for (const auto& part : owner->parts())
    parts.push_back(std::make_unique<AddedPart>(shared->describe().parameters.size(),
                                                std::make_unique<ForwardedPart>(owner, *part)));
  return std::make_unique<DecoratedModel>(shared, own, null, std::move(parts));
}

Option knots() {
  Option option = Option::json("knots", "[]", "Of a spline: rising values of the invariant, the first 0.");
  option.schema = Json{{"type", "array"}, {"items", {{"type", "number"}, {"minimum", 0}}}, {"maxItems", 14}}.dump();
  return option;
}

}  // namespace

MechanismFactory added_term() {
  std::vector<std::string> laws = law_names(), invariants = invariant_words();
  for (const std::string& name : volume_law_names())
    if (std::find(laws.begin(), laws.end(), name) == laws.end()) laws.push_back(name);
  std::erase(invariants, "across");
  MechanismFactory mechanism{
      .id = "added_term",
      .cause = "The energy has a term that the model lacks.",
      .stage = Stage::energy,
      .side = MechanismFactory::Side::positive,
      .plausible_max = 1e4,
      .plausible_effect = 2,
      .look_alikes = {"second_invariant", "matrix_stiffening", "chain_extensibility"},
      .isolated_by = "tests that vary the invariant of the term and hold the others",
      .reference = "Linka, Kuhl, Comput. Methods Appl. Mech. Eng. 403:115731 (2023), for the choice of terms",
      .options = {Option::choice("invariant", std::move(invariants), "I2", "What the term is a function of."),
                  Option::choice("law", std::move(laws), "linear", "How it grows; stretches have their own."),
                  Option::choice("family", {"axial", "circumferential", "diagonal", "single"}, "axial",
                                 "Which fibres, of the invariant fibre."),
                  Option::choice("dispersion", {"none", "rotational", "two_planes"}, "none",
                                 "How fibres scatter about their family."),
                  Option::choice("fibre_switch", {"strain", "stretch", "none"}, "strain", "When fibres carry load."),
                  knots()}};
  Options by_default;
  for (const Option& option : mechanism.options) by_default.set(option.name, *option.fallback);
  mechanism.parameters_of = [](const Options& options) {
    return own_parameters(*energy_of(read_terms(list_of(options))));
  };
  mechanism.parameters = mechanism.parameters_of(by_default);
  mechanism.wrap_model = wrapped;
  mechanism.writes_terms = true;
  return mechanism;
}

}  // namespace tunica::composed
