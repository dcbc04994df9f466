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

/// One option of a plugin object, as its author declares it.
///
/// An option is a key beside "type" in the object of the experiment file that makes a model, a test, an optimizer or a
/// mechanism. The declaration is all there is to write: the host parses the JSON, converts units, checks bounds and
/// choices, fills in the default and lists the option in the schema, in `tunica describe` and in the editor's help. A
/// factory never sees a value that the declaration forbids.
///
/// The functions below cover the usual cases in one line each:
///
///     Option::number("initial_step", 0.1, {1e-6, 1}, "First step, as a fraction of the range.")
///     Option::choice("selection", {"plus", "comma"}, "plus", "Who the next parents are.")
struct Option {
  /// What the JSON value has to be.
  enum class Kind {
    flag,      ///< true or false
    integer,   ///< a whole number
    number,    ///< a number without a unit
    quantity,  ///< a number in the base unit, or text with a unit such as "2 mm"
    choice,    ///< one of `choices`
    text,      ///< any text
    json       ///< anything; the plugin checks it
  };
  /// A value in C++. Options of the kinds choice, text and json are strings.
  using Value = std::variant<bool, std::int64_t, double, std::string>;
  /// Least and largest value, both allowed.
  struct Range {
    double least,  ///< in the base unit
        largest;   ///< in the base unit
  };

  /// Key in the experiment file: lower case, with underscores.
  std::string name;
  /// Decides which getter of Options reads it.
  Kind kind;
  /// The default, in base units; none = the user must give a value.
  std::optional<Value> fallback;
  /// One sentence for help and schema.
  std::string doc;
  /// Quantity: the base unit, in UDUNITS spelling.
  std::string unit = {};
  /// Integer, number, quantity: the least value.
  std::optional<double> min = {};
  /// Integer, number, quantity: the largest value.
  std::optional<double> max = {};
  /// Choice: the words that are allowed.
  std::vector<std::string> choices = {};
  /// Json: a JSON Schema of the value, for completion in editors; may be empty.
  std::string schema = {};
  // A function makes each kind, with what it needs and no more.
  /// A whole number with a default. Read it with Options::integer(), or with Options::count() if it is a size.
  ///
  /// In all six functions `doc` is one sentence, with a capital letter and a full stop.
  static Option integer(std::string name, std::int64_t fallback, Range range, std::string doc) {
    return {std::move(name), Kind::integer, fallback, std::move(doc), {}, range.least, range.largest};
  }
  /// A number without a unit, with a default. Read it with Options::number().
  static Option number(std::string name, double fallback, Range range, std::string doc) {
    return {std::move(name), Kind::number, fallback, std::move(doc), {}, range.least, range.largest};
  }
  /// A number with a unit, `least` or more; without a default the user must give one.
  ///
  /// The file may say "25 mm" or "1 in". Options::number() returns the value in the base unit `unit`, and `least` and
  /// `fallback` are in it as well.
  static Option quantity(std::string name, std::string unit, double least, std::string doc,
                         std::optional<double> fallback = {}) {
    Option option{std::move(name), Kind::quantity, {}, std::move(doc), std::move(unit), least};
    if (fallback) option.fallback = *fallback;
    return option;
  }
  /// One of several words. Without a default the user must choose. Read it with Options::text(), and compare it with
  /// the same words: no other word arrives.
  static Option choice(std::string name, std::vector<std::string> choices, std::optional<std::string> fallback,
                       std::string doc) {
    Option option{std::move(name), Kind::choice, {}, std::move(doc)};
    if (fallback) option.fallback = std::move(*fallback);
    option.choices = std::move(choices);
    return option;
  }
  /// Any JSON, as text; without a default the user must give it. The plugin reads it from Options::text() and throws
  /// InputError.
  static Option json(std::string name, std::optional<std::string> fallback, std::string doc) {
    Option option{std::move(name), Kind::json, {}, std::move(doc)};
    if (fallback) option.fallback = std::move(*fallback);
    return option;
  }
  /// Any text, with a default. The plugin checks it and throws InputError.
  static Option text(std::string name, std::string fallback, std::string doc) {
    return {std::move(name), Kind::text, std::move(fallback), std::move(doc)};
  }
};

/// The options of one object, checked: every declared option has a value of the declared kind, within its bounds.
///
/// A factory receives this and reads each option by its name. Defaults are filled in, so that no getter has one.
/// Options of the kind json arrive as JSON text, so that no JSON type crosses the plugin boundary.
///
///     starts_ = options.count("starts");
///
/// Errors: a getter throws InputError for a name that was not declared, and for an option of another kind. Both are
/// mistakes in the plugin, which `tunica plugin check` finds.
/// Threads: reading is safe from any thread.
/// Ownership: the object belongs to the host; a plugin copies the values that it keeps.
class Options {
 public:
  /// Sets a value and replaces an earlier one; it is not checked. Hosts and tests use it; a plugin only reads.
  void set(std::string name, Option::Value value) { values_.insert_or_assign(std::move(name), std::move(value)); }
  /// Whether an option of this name was declared. Mechanisms ask it, which share options with the tests that they wrap.
  [[nodiscard]] bool has(std::string_view name) const { return values_.find(name) != values_.end(); }
  /// The value of a flag.
  [[nodiscard]] bool flag(std::string_view name) const { return get<bool>(name); }
  /// The value of an integer option.
  [[nodiscard]] std::int64_t integer(std::string_view name) const { return get<std::int64_t>(name); }
  /// The value of an integer option that counts something: its declared range begins at 0 or above.
  [[nodiscard]] std::size_t count(std::string_view name) const { return static_cast<std::size_t>(integer(name)); }
  /// The value of a number, or of a quantity in its base unit.
  [[nodiscard]] double number(std::string_view name) const { return get<double>(name); }
  /// The value of a choice or of a text; of a json option its JSON text.
  [[nodiscard]] const std::string& text(std::string_view name) const { return get<std::string>(name); }
  /// All values by name, for code that passes options on.
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
