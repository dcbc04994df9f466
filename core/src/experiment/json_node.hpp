// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment/json_document.hpp"

namespace tunica::experiment {

/// A value of a document together with where it stands: asked for what it should be, it gives that or throws an
/// InputError that quotes what was found, names pointer, line and column, and says what is expected.
class Node {
 public:
  explicit Node(const JsonDocument& document) : Node(document, document.root(), "") {}

  [[nodiscard]] const std::string& pointer() const { return pointer_; }

  /// "file (/pointer, line 4, column 7)", for messages about it later on.
  [[nodiscard]] std::string place() const;
  /// "file: what (/pointer, line 4, column 7). help"
  [[noreturn]] void fail(std::string_view what, std::string_view help = {}) const;
  [[noreturn]] void fail_expected(std::string_view expected) const;

  [[nodiscard]] bool is_object() const;
  [[nodiscard]] bool is_array() const;
  [[nodiscard]] bool is_text() const;
  [[nodiscard]] bool is_number() const;
  [[nodiscard]] bool is_flag() const;
  [[nodiscard]] std::size_t size() const;    ///< members of an object, elements of an array
  [[nodiscard]] std::string dumped() const;  ///< the value as JSON text

  [[nodiscard]] std::optional<Node> find(const std::string& key) const;
  [[nodiscard]] Node require(const std::string& key, std::string_view owner) const;
  [[nodiscard]] Node child_or_self(const std::string& key) const { return find(key).value_or(*this); }
  [[nodiscard]] Node element(std::size_t i) const;
  /// Of an array, and of an object; refused where there are more than limits::entries.
  [[nodiscard]] std::vector<Node> elements(std::string_view expected) const;
  [[nodiscard]] std::vector<std::pair<std::string, Node>> members(std::string_view expected) const;

  void expect_object(std::string_view expected) const;
  /// An object with no other keys than these.
  void allow_only(const std::vector<std::string>& keys, std::string_view owner) const;

  // Asking is checking, so the answers of these may go unused.
  const std::string& text(std::string_view expected) const;
  bool flag(std::string_view expected) const;
  [[nodiscard]] double number(std::string_view expected) const;
  [[nodiscard]] std::int64_t integer(std::string_view expected) const;  ///< what is too large becomes the largest
  /// A whole number within a range; `what` is "a whole number of draws", to which messages add the range.
  [[nodiscard]] std::uint64_t count(std::string_view what, std::uint64_t at_least,
                                    std::uint64_t at_most = std::numeric_limits<std::uint64_t>::max()) const;
  /// A number in the base unit, or text with a unit that converts to it.
  [[nodiscard]] double quantity(std::string_view base_unit, std::string_view expected) const;
  /// One of the names; an unknown one is answered with the nearest.
  const std::string& one_of(const std::vector<std::string>& names, std::string_view noun) const;
  /// A name users choose: it becomes part of parameter names and of file names.
  void check_name(const std::string& name, std::string_view noun) const;

 private:
  [[nodiscard]] std::optional<std::uint64_t> whole() const;
  void refuse_many() const;

  Node(const JsonDocument& document, const Json& value, std::string pointer)
      : document_(&document), value_(&value), pointer_(std::move(pointer)) {}

  const JsonDocument* document_;
  const Json* value_;
  std::string pointer_;
};

}  // namespace tunica::experiment
