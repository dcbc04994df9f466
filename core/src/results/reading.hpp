// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

/// Reads the documents that tunica writes, also those of an older program, which may lack anything. Readers and writers
/// name a key by its constant in results/keys.hpp. A constant that the schemas do not declare does not compile.
namespace tunica::results {

using Json = nlohmann::ordered_json;

/// A key of a document. Names that users choose are no keys: entry() looks those up.
struct Key {
  std::string_view text;
  operator std::string() const { return std::string(text); }  // NOLINT(google-explicit-constructor): a writer's key
};

/// The value of a key; null where there is none, or no object.
const Json& member(const Json& object, Key key);
/// The value of a name that a user chose, such as that of a parameter; null where there is none, or no object.
const Json& entry(const Json& object, std::string_view name);
/// The list of a key; an empty one where there is none.
const Json& list(const Json& object, Key key);
/// Text of a key; "" where there is none.
std::string word(const Json& object, Key key);
/// Number of a key; NaN where there is none.
double number(const Json& object, Key key);
/// The strings of a list.
std::vector<std::string> words(const Json& list);

}  // namespace tunica::results
