// SPDX-License-Identifier: Apache-2.0
#include "conformance/declarations.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <type_traits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/units.hpp"

namespace tunica::conformance {
namespace {

constexpr const char* demanded = "names, units, bounds, defaults and documentation with what tunica needs of them";

bool plain(const std::string& name) {
  return !name.empty() &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; }) &&
         std::isalpha(static_cast<unsigned char>(name.front()));
}

/// The fault of an option; empty = none.
std::string flaw_of(const Option& option) {
  using Kind = Option::Kind;
  const std::string what = fmt::format("the option '{}'", option.name);
  if (!plain(option.name)) return what + " is no plain name of letters, digits and underscores";
  if (option.doc.empty()) return what + " has no doc";
  if (option.kind == Kind::quantity && !data::is_unit(option.unit))
    return fmt::format("{} is in '{}', which is no unit that UDUNITS knows", what, option.unit);
  if ((option.kind == Kind::choice) == option.choices.empty())
    return what + (option.choices.empty() ? " has no choices" : " has choices, and is none");
  if (!option.schema.empty() && !nlohmann::json::parse(option.schema, nullptr, false).is_object())
    return what + " has a schema that is no JSON object";
  if (!option.fallback) return {};
  const Option::Value& value = *option.fallback;
  const bool fits = option.kind == Kind::flag      ? std::holds_alternative<bool>(value)
                    : option.kind == Kind::integer ? std::holds_alternative<std::int64_t>(value)
                    : option.kind == Kind::number || option.kind == Kind::quantity
                        ? std::holds_alternative<double>(value)
                        : std::holds_alternative<std::string>(value);
  if (!fits) return what + " has a default of another kind than it declares";
  if (option.kind == Kind::choice &&
      std::find(option.choices.begin(), option.choices.end(), std::get<std::string>(value)) == option.choices.end())
    return what + " has a default that is not among its choices";
  const double number = std::holds_alternative<double>(value) ? std::get<double>(value)
                        : std::holds_alternative<std::int64_t>(value)
                            ? static_cast<double>(std::get<std::int64_t>(value))
                            : NAN;
  if ((option.min && number < *option.min) || (option.max && number > *option.max))
    return what + " has a default outside its own bounds";
  return {};
}

std::string flaw_of(const Parameter& parameter) {
  const std::string what = fmt::format("the parameter '{}'", parameter.name);
  if (!plain(parameter.name)) return what + " is no plain name of letters, digits and underscores";
  if (!data::is_unit(parameter.unit))
    return fmt::format("{} is in '{}', which is no unit that UDUNITS knows", what, parameter.unit);
  if (parameter.doc.empty()) return what + " has no doc";
  if (!std::isfinite(parameter.min) || !std::isfinite(parameter.max) || !(parameter.min < parameter.max))
    return fmt::format("{} has bounds {} and {}; expected finite ones, min < max", what, parameter.min, parameter.max);
  if (!(parameter.initial >= parameter.min && parameter.initial <= parameter.max))
    return fmt::format("{} begins at {}, outside its bounds {} and {}", what, parameter.initial, parameter.min,
                       parameter.max);
  if (parameter.scale == Scale::log && !(parameter.min > 0))
    return fmt::format("{} has a logarithmic scale and min = {}; expected min > 0", what, parameter.min);
  return {};
}

std::string flaw_of(const Observable& observable) {
  if (!plain(observable.name)) return fmt::format("the observable '{}' is no plain name", observable.name);
  if (!data::is_unit(observable.unit))
    return fmt::format("the observable '{}' is in '{}', which is no unit that UDUNITS knows", observable.name,
                       observable.unit);
  return observable.doc.empty() ? fmt::format("the observable '{}' has no doc", observable.name) : std::string();
}

template <class List>
std::string flaw_of_all(const List& list) {
  std::set<std::string> names;
  for (const auto& one : list) {
    if (std::string flaw = flaw_of(one); !flaw.empty()) return flaw;
    if (!names.insert(one.name).second) return fmt::format("'{}' is declared twice", one.name);
  }
  return {};
}

Verdict verdict(std::string flaw) {
  Verdict found{.compared = demanded};
  found.counter_example = std::move(flaw);
  return found;
}

template <class Factory>
std::string flaw_of_head(const Factory& factory) {
  if (factory.doc.empty()) return "there is no doc: one sentence, which `tunica list` prints";
  return flaw_of_all(factory.options);
}

std::string flaw_of(const MechanismFactory& m, const plugins::Catalogue& catalogue) {
  using Side = MechanismFactory::Side;
  if (m.cause.empty()) return "there is no cause: one sentence that says what physically happens";
  if (m.isolated_by.empty()) return "isolated_by is empty: say which kind of test separates it";
  if (m.parameters.empty()) return "there are no parameters; the first is the amplitude";
  if (std::string flaw = flaw_of_all(m.parameters); !flaw.empty()) return flaw;
  if (std::string flaw = flaw_of_all(m.options); !flaw.empty()) return flaw;
  const Parameter& amplitude = m.parameters.front();
  if (!(m.null >= amplitude.min && m.null <= amplitude.max)) return "the null lies outside the bounds of the amplitude";
  if (!(amplitude.min <= m.plausible_min && m.plausible_min <= m.null && m.null < m.plausible_max &&
        m.plausible_max <= amplitude.max))
    return fmt::format("min {} <= plausible_min {} <= null {} < plausible_max {} <= max {} does not hold",
                       amplitude.min, m.plausible_min, m.null, m.plausible_max, amplitude.max);
  if (m.side == Side::positive && amplitude.min != m.null)
    return fmt::format("the side is 'positive', so the least amplitude is the null, {}; found {}", m.null,
                       amplitude.min);
  if (m.side != Side::positive && !(m.plausible_min < m.null))
    return "both sides are admissible, and plausible_min is not below the null";
  for (const std::string& other : m.look_alikes)
    if (!catalogue.mechanisms().contains(other) || other == m.id)
      return fmt::format("the look-alike '{}' is no other mechanism that is loaded", other);
  for (const std::string& type : m.applies_to)
    if (!catalogue.tests().contains(type))
      return fmt::format("it applies to '{}', which is no test that is loaded", type);
  for (const auto& setting : m.scan)
    for (const auto& [name, value] : setting) {
      const auto among = [&, wanted = name](const auto& list) {
        return std::any_of(list.begin(), list.end(), [&](const auto& one) { return one.name == wanted; });
      };
      if (!among(m.parameters) && !among(m.options))
        return fmt::format("scan names '{}', which is neither a parameter nor an option", name);
    }
  return {};
}

}  // namespace

Verdict declaration_is_complete(const ModelFactory& factory) { return verdict(flaw_of_head(factory)); }
Verdict declaration_is_complete(const OptimizerFactory& factory) { return verdict(flaw_of_head(factory)); }
Verdict declaration_is_complete(const TestFactory& factory) {
  std::string flaw = flaw_of_head(factory);
  if (flaw.empty()) flaw = flaw_of_all(factory.observables);
  if (flaw.empty()) flaw = flaw_of_all(factory.parameters);
  const auto has = [&](Observable::Role role) {
    return std::any_of(factory.observables.begin(), factory.observables.end(),
                       [&](const auto& o) { return o.role == role; });
  };
  if (flaw.empty() && !has(Observable::Role::channel)) flaw = "no observable is a channel, so nothing could be fitted";
  return verdict(std::move(flaw));
}
Verdict declaration_is_complete(const MechanismFactory& factory, const plugins::Catalogue& catalogue) {
  return verdict(flaw_of(factory, catalogue));
}

Verdict parameters_are_declared(const std::vector<Parameter>& parameters) { return verdict(flaw_of_all(parameters)); }

Verdict parameters_are_declared(const TestDescription& description, const TestFactory& factory) {
  std::string flaw = flaw_of_all(description.parameters);
  if (flaw.empty() && description.nulls.size() != description.parameters.size())
    flaw = fmt::format("{} nulls for {} parameters; NaN stands for one that is always there", description.nulls.size(),
                       description.parameters.size());
  if (flaw.empty() && description.diagnostics.size() != description.diagnostic_units.size())
    flaw =
        fmt::format("{} units for {} diagnostics", description.diagnostic_units.size(), description.diagnostics.size());
  for (const Parameter& one : description.parameters)
    if (flaw.empty() && std::none_of(factory.parameters.begin(), factory.parameters.end(),
                                     [&](const Parameter& other) { return other.name == one.name; }))
      flaw = fmt::format("the test has a parameter '{}' that TestFactory::parameters does not list", one.name);
  for (std::size_t k = 0; k < description.parameters.size() && flaw.empty(); ++k) {
    const Parameter& one = description.parameters[k];
    const double null = description.nulls[k];
    if (!std::isnan(null) && !(null >= one.min && null <= one.max))
      flaw = fmt::format("the null {} of '{}' lies outside its bounds", null, one.name);
  }
  return verdict(std::move(flaw));
}

}  // namespace tunica::conformance
