// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conformance/partners.hpp"
#include "conformance/verdict.hpp"
#include "tunica/error.hpp"

namespace tunica::conformance {

/// Words of some options that are one of several: (name, word).
using Choices = std::vector<std::pair<std::string, std::string>>;

/// "direction = axial, plane = in_the_wall"
inline std::string words_of(const Choices& choices) {
  std::vector<std::string> words;
  for (const auto& [name, word] : choices) words.push_back(fmt::format("{} = {}", name, word));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// All words of each option with all of the others.
inline std::vector<Choices> combinations(const std::vector<Option>& options) {
  std::vector<Choices> all{{}};
  for (const Option& option : options) {
    if (option.kind != Option::Kind::choice) continue;
    std::vector<Choices> longer;
    for (const Choices& begun : all)
      for (const std::string& word : option.choices) {
        longer.push_back(begun);
        longer.back().emplace_back(option.name, word);
      }
    all = std::move(longer);
  }
  return all;
}

/// How many combinations of choices there are.
inline std::size_t combination_count(const std::vector<Option>& options) {
  std::size_t count = 1;
  for (const Option& option : options) count *= std::max<std::size_t>(1, option.choices.size());
  return count;
}

/// So many combinations are tried all; of more, each word once.
constexpr std::size_t many_combinations = 24;

/// The other choices that properties are checked with: all combinations but that of the plausible options, or, if these
/// are more than `most`, each other word by itself.
inline std::vector<Choices> other_choices(const std::vector<Option>& declared, std::size_t most = many_combinations) {
  const Options plausible = plausible_options(declared);
  std::vector<Choices> others;
  if (combination_count(declared) <= most) {
    for (Choices& choices : combinations(declared))
      if (std::any_of(choices.begin(), choices.end(),
                      [&](const auto& one) { return plausible.text(one.first) != one.second; }))
        others.push_back(std::move(choices));
    return others;
  }
  for (const Option& option : declared)
    for (const std::string& word : option.choices)
      if (plausible.text(option.name) != word) others.push_back({{option.name, word}});
  return others;
}

/// Plausible options with these choices made.
inline Options with_choices(const std::vector<Option>& declared, const Choices& choices) {
  Options options = plausible_options(declared);
  for (const auto& [name, word] : choices) options.set(name, word);
  return options;
}

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
