// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "tunica/error.hpp"

namespace tunica {

/// One option of a plugin object as its author declares it; the host parses the JSON, converts units, checks
/// bounds and choices, fills the default in and lists it in the schema.
struct Option {
  /// What the JSON value has to be. quantity: a number in the base unit, or text with a unit ("2 mm"); choice: one
  /// of `choices`; json: anything, checked by the plugin.
  enum class Kind { flag, integer, number, quantity, choice, text, json };
  using Value = std::variant<bool, std::int64_t, double, std::string>;  ///< choice, text and json are strings

  std::string name;                       ///< key of the plugin object in the experiment file
  Kind kind;                              ///< also says which getter of Options reads it
  std::optional<Value> fallback;          ///< the default, in base units; none = the user must give it
  std::string doc;                        ///< one sentence
  std::string unit = {};                  ///< quantity: the base unit, in UDUNITS spelling
  std::optional<double> min = {};         ///< integer, number, quantity: inclusive
  std::optional<double> max = {};         ///< as min
  std::vector<std::string> choices = {};  ///< choice: the words there are
};

/// The checked options of one object: every declared option has a value, of the declared kind. `json` options
/// cross as JSON text, so that no JSON type crosses the plugin boundary.
class Options {
 public:
  /// For the host and for tests; replaces what there was.
  void set(std::string name, Option::Value value) { values_.insert_or_assign(std::move(name), std::move(value)); }
  /// False for a name that was not declared.
  [[nodiscard]] bool has(std::string_view name) const { return values_.find(name) != values_.end(); }
  /// Of kind flag. Every getter throws InputError for an undeclared name and for another kind.
  [[nodiscard]] bool flag(std::string_view name) const { return get<bool>(name); }
  /// Of kind integer.
  [[nodiscard]] std::int64_t integer(std::string_view name) const { return get<std::int64_t>(name); }
  /// Of kind number, or quantity in its base unit.
  [[nodiscard]] double number(std::string_view name) const { return get<double>(name); }
  /// Of kind choice or text; of kind json its JSON text.
  [[nodiscard]] const std::string& text(std::string_view name) const { return get<std::string>(name); }
  /// All of them by name, for code that hands options on.
  [[nodiscard]] const std::map<std::string, Option::Value, std::less<>>& values() const { return values_; }

 private:
  template <class T>
  const T& get(std::string_view name) const {
    const auto found = values_.find(name);
    if (found == values_.end()) throw InputError("the option '" + std::string(name) + "' was not declared");
    if (const T* value = std::get_if<T>(&found->second)) return *value;
    throw InputError("the option '" + std::string(name) + "' is read as a kind it was not declared with");
  }
  std::map<std::string, Option::Value, std::less<>> values_;
};

}  // namespace tunica
