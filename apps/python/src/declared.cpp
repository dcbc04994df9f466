// SPDX-License-Identifier: Apache-2.0
#include "declared.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "data/nearest.hpp"
#include "data/units.hpp"
#include "tunica/error.hpp"

namespace tunica::python {

namespace {

template <class T>
T get(const py::handle& one, const char* key) {
  return one[key].cast<T>();
}

/// Throws InputError where the program does not know the unit.
void check_unit(const std::string& unit, const std::string& of) {
  if (data::is_unit(unit)) return;
  try {
    (void)data::convert(1, unit, "kPa");  // says which unit is nearest
  } catch (const InputError& problem) {
    throw InputError(fmt::format("{}: {}", of, problem.what()));
  }
}

/// The host converts and checks columns of these kinds, in their base units.
void check_base(const std::string& unit, std::string_view base, const std::string& of, std::string_view what) {
  if (unit != base)
    throw InputError(fmt::format("{}: found the unit '{}' for a {}, expected '{}'; data files may have any unit of it",
                                 of, unit, what, base));
}

void check_word(const std::string& word, const std::vector<std::string>& known, const std::string& of) {
  if (std::find(known.begin(), known.end(), word) == known.end())
    throw InputError(fmt::format("{}: found '{}'. {}", of, data::excerpt(word), data::suggestion(word, known)));
}

Option::Value value_of(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
  if (py::isinstance<py::int_>(value)) return value.cast<std::int64_t>();
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  return value.cast<double>();
}

}  // namespace

std::vector<Parameter> parameters_from(const py::list& declared, const std::string& owner) {
  std::vector<Parameter> parameters;
  for (const auto& one : declared) {
    Parameter parameter{get<std::string>(one, "name"), get<std::string>(one, "unit"),
                        get<double>(one, "initial"),   get<double>(one, "min"),
                        get<double>(one, "max"),       get<bool>(one, "log") ? Scale::log : Scale::linear,
                        get<std::string>(one, "doc"),  get<std::string>(one, "reference")};
    if (!(std::isfinite(parameter.min) && std::isfinite(parameter.max) && parameter.min <= parameter.initial &&
          parameter.initial <= parameter.max) ||
        (parameter.scale == Scale::log && parameter.min <= 0))
      throw InputError(
          fmt::format("{}: the parameter '{}' starts at {:g} within {:g} … {:g}; expected min ≤ initial ≤ "
                      "max, finite, and min > 0 on a logarithmic scale",
                      owner, parameter.name, parameter.initial, parameter.min, parameter.max));
    check_unit(parameter.unit, fmt::format("{}: the parameter '{}'", owner, parameter.name));
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

std::vector<Option> options_from(const py::list& declared, const std::string& owner) {
  std::vector<Option> options;
  for (const auto& one : declared) {
    Option option{get<std::string>(one, "name"), Option::Kind::number, {}, get<std::string>(one, "doc")};
    option.fallback = value_of(one["default"]);
    option.kind = std::holds_alternative<bool>(*option.fallback)           ? Option::Kind::flag
                  : std::holds_alternative<std::int64_t>(*option.fallback) ? Option::Kind::integer
                  : std::holds_alternative<double>(*option.fallback)       ? Option::Kind::number
                                                                           : Option::Kind::text;
    if (option.name.empty()) throw InputError(fmt::format("{}: an option has no name; give each one", owner));
    options.push_back(std::move(option));
  }
  return options;
}

std::vector<Observable> observables_from(const py::list& declared, const std::string& owner) {
  std::vector<Observable> observables;
  bool measures = false;
  for (const auto& one : declared) {
    const auto role = get<std::string>(one, "role"), kind = get<std::string>(one, "kind");
    Observable observable{get<std::string>(one, "name"), get<std::string>(one, "unit"), Observable::Role::channel,
                          false, ""};
    const std::string of = fmt::format("{}: the observable '{}'", owner, observable.name);
    check_word(role, {"abscissa", "channel", "time"}, of + ": role");
    check_word(kind, {"plain", "stress", "stretch"}, of + ": kind");
    check_unit(observable.unit, of);
    if (role == "time") check_base(observable.unit, "s", of, "time");
    if (kind == "stretch") check_base(observable.unit, "1", of, "stretch");
    if (kind == "stress") check_base(observable.unit, "kPa", of, "stress");
    observable.role = role == "abscissa" ? Observable::Role::abscissa
                      : role == "time"   ? Observable::Role::time
                                         : Observable::Role::channel;
    observable.kind = kind == "stretch"  ? Observable::Kind::stretch
                      : kind == "stress" ? Observable::Kind::stress
                                         : Observable::Kind::plain;
    observable.required = get<bool>(one, "required");
    observable.doc = get<std::string>(one, "doc");
    measures = measures || observable.role == Observable::Role::channel;
    observables.push_back(std::move(observable));
  }
  if (!measures) throw InputError(fmt::format("{}: nothing is measured; add at least one channel", owner));
  return observables;
}

}  // namespace tunica::python
