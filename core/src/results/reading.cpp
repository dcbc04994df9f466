// SPDX-License-Identifier: Apache-2.0
#include "results/reading.hpp"

#include <cmath>

namespace tunica::results {

const Json& entry(const Json& object, std::string_view name) {
  static const Json nothing;
  if (!object.is_object()) return nothing;
  const auto found = object.find(std::string(name));
  return found == object.end() ? nothing : *found;
}

const Json& member(const Json& object, Key key) { return entry(object, key.text); }

const Json& list(const Json& object, Key key) {
  static const Json nothing = Json::array();
  const Json& value = member(object, key);
  return value.is_array() ? value : nothing;
}

std::string word(const Json& object, Key key) {
  const Json& value = member(object, key);
  return value.is_string() ? value.get<std::string>() : "";
}

double number(const Json& object, Key key) {
  const Json& value = member(object, key);
  return value.is_number() ? value.get<double>() : NAN;
}

std::vector<std::string> words(const Json& list) {
  std::vector<std::string> result;
  if (list.is_array())
    for (const Json& one : list)
      if (one.is_string()) result.push_back(one.get<std::string>());
  return result;
}

}  // namespace tunica::results
