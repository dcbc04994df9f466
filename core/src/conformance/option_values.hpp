// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "conformance/partners.hpp"
#include "conformance/verdict.hpp"
#include "tunica/error.hpp"

namespace tunica::conformance {

/// Values of one option at the edges of what it declares: its choices, both flags, its bounds.
inline std::vector<std::pair<std::string, Option::Value>> edges_of(const Option& option) {
  std::vector<std::pair<std::string, Option::Value>> values;
  for (const std::string& choice : option.choices) values.emplace_back(choice, choice);
  if (option.kind == Option::Kind::flag) values = {{"true", true}, {"false", false}};
  for (const auto& bound : {option.min, option.max}) {
    if (!bound) continue;
    if (option.kind == Option::Kind::integer)
      values.emplace_back(fmt::format("{}", *bound), static_cast<std::int64_t>(*bound));
    else
      values.emplace_back(fmt::format("{}", *bound), *bound);
  }
  return values;
}

/// Makes the thing with each of them, the others at their defaults: it is made, or refuses them in words (InputError).
template <class Make>
Verdict made_with_every_option(const std::vector<Option>& declared, const Make& make) {
  const std::string compared = "what is made with each choice and bound of the options with: an object, or words";
  std::size_t count = 0;
  for (const Option& option : declared)
    for (const auto& [word, value] : edges_of(option)) {
      Options options = plausible_options(declared);
      options.set(option.name, value);
      ++count;
      try {
        make(options);
      } catch (const InputError&) {
        continue;
      } catch (const std::exception& problem) {
        return broken(compared, fmt::format("with {} = {}: {}", option.name, word, problem.what()));
      }
    }
  if (count == 0) return not_checked(compared, "it has no options with choices or bounds");
  return {.compared = compared, .note = fmt::format("{} values", count)};
}

}  // namespace tunica::conformance
