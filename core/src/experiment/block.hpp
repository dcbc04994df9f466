// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "experiment/enum_names.hpp"
#include "experiment/json_node.hpp"
#include "experiment/schema_parts.hpp"
#include "text/codes.hpp"

/// The blocks of an experiment file: each key is declared once, and reader, schema and writer follow from it.
namespace tunica::experiment {

/// A key of a block that fills a T.
template <class T>
struct Key {
  std::string name;
  std::function<Json()> schema;
  std::function<void(const Node&, T&)> read = {};  ///< none: read with others, by whoever reads the block
  std::function<Json(const T&)> write = {};  ///< as input.json has it; null leaves the key out, as does no function
  bool required = false;
  bool defined = false;  ///< the schema has it once, in its definitions
};

template <class T>
Key<T> required(Key<T> key) {
  key.required = true;
  return key;
}

template <class T>
Key<T> defined(Key<T> key) {
  key.defined = true;
  return key;
}

/// The key is left out of input.json where it has this value.
template <class T>
Key<T> silent_at(Key<T> key, Json value) {
  key.write = [write = std::move(key.write), value = std::move(value)](const T& from) {
    Json json = write(from);
    return json == value ? Json() : json;
  };
  return key;
}

/// An object of the file with these keys and no others. They are read in order, so a key may look at what the earlier
/// ones gave.
template <class T>
class Block {
 public:
  /// `owner` is for messages, "a stage"; `description` for the schema.
  Block(std::string owner, std::string description, std::vector<Key<T>> keys)
      : owner_(std::move(owner)), description_(std::move(description)), keys_(std::move(keys)) {}

  /// What a message expects in place of what is no object, "a layer, {\"model\": …},".
  Block expecting(std::string shape) && {
    shape_ = std::move(shape);
    return std::move(*this);
  }
  [[nodiscard]] const std::vector<Key<T>>& keys() const { return keys_; }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Key<T>& key : keys_) names.push_back(key.name);
    return names;
  }
  /// Throws InputError where the node is no object, or has another key.
  void allow_only(const Node& node) const {
    node.expect_object(shape_);
    node.allow_only(names(), owner_);
  }
  /// Throws InputError at an unknown key, a missing one, and whatever a key refuses.
  void read(const Node& node, T& into) const {
    allow_only(node);
    for (const Key<T>& key : keys_) {
      const std::optional<Node> child = key.required ? node.require(key.name, owner_) : node.find(key.name);
      if (child && key.read) key.read(*child, into);
    }
  }
  [[nodiscard]] Json schema() const {
    std::vector<std::string> needed;
    for (const Key<T>& key : keys_)
      if (key.required) needed.push_back(key.name);
    return object_schema(description_, properties(), needed);
  }
  [[nodiscard]] Json properties() const {
    Json properties = Json::object();
    for (const Key<T>& key : keys_) properties[key.name] = key.defined ? reference(key.name) : key.schema();
    return properties;
  }
  void define(Json& definitions) const {
    for (const Key<T>& key : keys_)
      if (key.defined) definitions[key.name] = key.schema();
  }
  [[nodiscard]] Json write(const T& from) const {
    Json json = Json::object();
    for (const Key<T>& key : keys_)
      if (Json value = key.write ? key.write(from) : Json(); !value.is_null()) json[key.name] = std::move(value);
    return json;
  }

 private:
  std::string owner_, description_, shape_ = "an object";
  std::vector<Key<T>> keys_;
};

template <class V>
Json written(const V& value) {
  return Json(value);
}
template <class V>
Json written(const std::optional<V>& value) {
  return value ? Json(*value) : Json();
}

template <class Enumeration, std::size_t count>
Json written_code(const text::Codes<Enumeration, count>& table, Enumeration value) {
  return Json(text::code_of(table, value));
}
template <class Enumeration, std::size_t count>
Json written_code(const text::Codes<Enumeration, count>& table, std::optional<Enumeration> value) {
  return value ? Json(text::code_of(table, *value)) : Json();
}

/// A key whose value is a member of T, perhaps an optional one; `parse` reads and checks it.
template <class T, class Member, class Parse>
Key<T> member_key(std::string name, std::function<Json()> schema, Member T::*member, Parse parse) {
  return {std::move(name), std::move(schema), [=](const Node& node, T& into) { into.*member = parse(node); },
          [=](const T& from) { return written(from.*member); }};
}

template <class T, class Member>
Key<T> flag_key(std::string name, std::string doc, Member T::*member) {
  return member_key(
      std::move(name), [=] { return flag_schema(doc); }, member,
      [](const Node& node) { return node.flag("true or false"); });
}

template <class T, class Member>
Key<T> text_key(std::string name, std::string doc, Member T::*member, std::string expected) {
  return member_key(
      std::move(name), [=] { return text_schema(doc); }, member, [=](const Node& node) { return node.text(expected); });
}

/// A whole number; `what` is "a whole number of draws".
template <class T, class Member>
Key<T> count_key(std::string name, std::string doc, Member T::*member, std::string what, std::uint64_t least,
                 std::optional<std::uint64_t> most = {}) {
  return member_key(
      std::move(name), [=] { return count_schema(doc, least, most); }, member,
      [=](const Node& node) { return most ? node.count(what, least, *most) : node.count(what, least); });
}

/// A quantity in a base unit, or text with another unit; `check` may refuse it.
template <class T, class Member, class Check>
Key<T> quantity_key(std::string name, std::string doc, Member T::*member, std::string unit, std::string what,
                    Check check) {
  return member_key(
      std::move(name), [=] { return quantity_schema(doc); }, member,
      [=](const Node& node) {
        const double value = node.quantity(unit, what);
        check(node, value);
        return value;
      });
}

/// One of the words of an enumeration.
template <class T, class Member, class Enumeration, std::size_t count>
Key<T> code_key(std::string name, std::string doc, Member T::*member, const text::Codes<Enumeration, count>& table,
                std::string noun) {
  Key<T> key = member_key(
      std::move(name), [=] { return choice_schema(doc, names_in(table)); }, member,
      [=](const Node& node) { return *text::value_of(table, node.one_of(names_in(table), noun)); });
  key.write = [=](const T& from) { return written_code(table, from.*member); };
  return key;
}

/// A name of an entry of the file.
template <class T, class Member>
Key<T> name_key(std::string name, std::string doc, Member T::*member, std::vector<std::string> names) {
  return member_key(
      name, [=] { return text_schema(doc); }, member, [=](const Node& node) { return node.one_of(names, name); });
}

/// A key that holds a block of the same T, left out where nothing in it is written.
template <class T>
Key<T> block_key(std::string name, Block<T> block) {
  return {std::move(name), [=] { return block.schema(); }, [=](const Node& node, T& into) { block.read(node, into); },
          [=](const T& from) {
            Json json = block.write(from);
            return json.empty() ? Json() : json;
          }};
}

}  // namespace tunica::experiment
