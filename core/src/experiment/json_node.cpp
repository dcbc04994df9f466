// SPDX-License-Identifier: Apache-2.0
#include "experiment/json_node.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/units.hpp"
#include "experiment/limits.hpp"
#include "experiment/placed_error.hpp"
#include "experiment/suggest.hpp"
#include "tunica/error.hpp"

namespace tunica::experiment {
namespace {

std::string described(const Json& value) {
  switch (value.type()) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::boolean:
      return value.get<bool>() ? "true" : "false";
    case Json::value_t::string:
      return fmt::format("the text '{}'", excerpt(value.get_ref<const std::string&>()));
    case Json::value_t::array:
      return "a list";
    case Json::value_t::object:
      return "an object";
    default:
      return fmt::format("the number {}", value.dump());
  }
}

std::string shown_pointer(const std::string& pointer) { return excerpt(pointer, 300); }

}  // namespace

std::string Node::place() const {
  const auto [line, column] = document_->place(pointer_);
  return fmt::format("{} ({}, line {}, column {})", document_->file().string(), shown_pointer(pointer_), line, column);
}

void Node::fail(std::string_view what, std::string_view help) const {
  const auto [line, column] = document_->place(pointer_);
  throw PlacedError(
      fmt::format("{}: {} ({}{}line {}, column {}).{}{}", document_->file().string(), what, shown_pointer(pointer_),
                  pointer_.empty() ? "" : ", ", line, column, help.empty() ? "" : " ", help),
      line, column);
}

void Node::fail_expected(std::string_view expected) const {
  fail(fmt::format("found {} where {} is expected", described(*value_), expected));
}

bool Node::is_object() const { return value_->is_object(); }
bool Node::is_array() const { return value_->is_array(); }
bool Node::is_text() const { return value_->is_string(); }
bool Node::is_number() const { return value_->is_number(); }
bool Node::is_flag() const { return value_->is_boolean(); }
std::size_t Node::size() const { return value_->size(); }
std::string Node::dumped() const { return value_->dump(); }

std::optional<Node> Node::find(const std::string& key) const {
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return Node(*document_, *found, child_pointer(pointer_, key));
}

Node Node::require(const std::string& key, std::string_view owner) const {
  if (auto found = find(key)) return *std::move(found);
  fail(fmt::format("the key '{}' is missing in {}", key, owner), "Add it.");
}

void Node::refuse_many() const {
  if (size() > limits::entries)
    fail(fmt::format("{} has {} entries, and at most {} are allowed", is_array() ? "the list" : "the object", size(),
                     limits::entries),
         "Take out what is not needed, or use several files.");
}

Node Node::element(std::size_t i) const { return {*document_, value_->at(i), fmt::format("{}/{}", pointer_, i)}; }

std::vector<Node> Node::elements(std::string_view expected) const {
  if (!is_array()) fail_expected(expected);
  refuse_many();
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < value_->size(); ++i) nodes.push_back(element(i));
  return nodes;
}

std::vector<std::pair<std::string, Node>> Node::members(std::string_view expected) const {
  if (!is_object()) fail_expected(expected);
  refuse_many();
  std::vector<std::pair<std::string, Node>> nodes;
  for (const auto& [key, value] : value_->items())
    nodes.emplace_back(key, Node(*document_, value, child_pointer(pointer_, key)));
  return nodes;
}

void Node::expect_object(std::string_view expected) const {
  if (!is_object()) fail_expected(expected);
}

void Node::allow_only(const std::vector<std::string>& keys, std::string_view owner) const {
  for (const auto& [key, child] : members("an object"))
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      child.fail(fmt::format("unknown key '{}' in {}", excerpt(key), owner), suggestion(key, keys));
}

const std::string& Node::text(std::string_view expected) const {
  if (!is_text()) fail_expected(expected);
  return value_->get_ref<const std::string&>();
}

bool Node::flag(std::string_view expected) const {
  if (!is_flag()) fail_expected(expected);
  return value_->get<bool>();
}

double Node::number(std::string_view expected) const {
  if (!is_number()) fail_expected(expected);
  return value_->get<double>();  // finite: the parser refuses what overflows
}

std::int64_t Node::integer(std::string_view expected) const {
  if (value_->is_number_integer() && !value_->is_number_unsigned()) return value_->get<std::int64_t>();
  constexpr std::uint64_t largest = std::numeric_limits<std::int64_t>::max();
  const auto value = whole();
  if (!value) fail_expected(expected);
  return static_cast<std::int64_t>(std::min(*value, largest));
}

std::optional<std::uint64_t> Node::whole() const {
  constexpr double exact = 9007199254740992.0;  // 2^53: 6e4 is a fine way to write 60000
  if (value_->is_number_unsigned()) return value_->get<std::uint64_t>();
  if (!value_->is_number_float()) return std::nullopt;
  const auto value = value_->get<double>();
  if (!(value >= 0 && value <= exact && value == std::floor(value))) return std::nullopt;
  return static_cast<std::uint64_t>(value);
}

std::uint64_t Node::count(std::string_view what, std::uint64_t at_least, std::uint64_t at_most) const {
  const auto value = whole();
  if (value && *value >= at_least && *value <= at_most) return *value;
  // The message states the largest number only if the value exceeds it.
  const bool bounded = at_most < std::numeric_limits<std::uint64_t>::max() || (is_number() && number(what) >= 0x1p64);
  fail_expected(bounded ? fmt::format("{} from {} to {}", what, at_least, at_most)
                        : fmt::format("{} from {}", what, at_least));
}

double Node::quantity(std::string_view base_unit, std::string_view expected) const {
  if (is_number()) return number(expected);
  if (!is_text())
    fail_expected(
        fmt::format("{} (a number in {}, or text with a unit such as \"1.5 {}\")", expected, base_unit, base_unit));
  try {
    return data::parse_quantity(text(expected), base_unit);
  } catch (const InputError& error) {
    fail(fmt::format("found '{}' where {} in {} is expected", excerpt(text(expected)), expected, base_unit),
         error.what());
  }
}

const std::string& Node::one_of(const std::vector<std::string>& names, std::string_view noun) const {
  const std::string& name = text(fmt::format(
      "the name of {} {}", std::string_view("aeiou").find(noun.front()) == std::string_view::npos ? "a" : "an", noun));
  if (std::find(names.begin(), names.end(), name) == names.end())
    fail(fmt::format("unknown {} '{}'", noun, excerpt(name)), suggestion(name, names));
  return name;
}

void Node::check_name(const std::string& name, std::string_view noun) const {
  const auto usual = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || static_cast<unsigned char>(c) >= 0x80;
  };
  if (name.find('.') != std::string::npos)
    fail(fmt::format("the {} name '{}' contains a dot", noun, excerpt(name)),
         "Dots join the parts of parameter names, as in viscoelasticity.tau; use '_' or '-' instead.");
  if (name.empty() || name.size() > 100 || name.front() == '-' || !std::all_of(name.begin(), name.end(), usual) ||
      !text::is_plain(name))
    fail(fmt::format("the {} name '{}' cannot be part of file and parameter names", noun, excerpt(name)),
         "Use letters, digits, '_' and '-', not '-' first.");
}

}  // namespace tunica::experiment
