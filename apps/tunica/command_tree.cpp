// SPDX-License-Identifier: Apache-2.0
#include "command_tree.hpp"

#include <CLI/CLI.hpp>

namespace tunica::app {

namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

Argument argument_of(const CLI::Option& option) {
  Argument argument;
  for (const auto& name : option.get_snames()) argument.names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) argument.names.push_back("--" + name);
  argument.doc = option.get_description();
  argument.required = option.get_required();
  const int most = option.get_items_expected_max();
  argument.takes = most > 2 ? 1 : most;  // one that is named again for another value
  argument.repeats = most > 2;
  // A validator adds itself behind a colon: "N:INT in [1 - 1024]", "TEXT:{a,b}".
  const std::string type = option.get_type_name();
  if (most > 0) argument.value = type.substr(0, type.find(':'));
  argument.label = argument.names.empty() ? option.get_name() : argument.names.back();
  const std::size_t set = type.find(":{");
  if (set != std::string::npos && type.back() == '}')
    argument.choices = split(type.substr(set + 2, type.size() - set - 3), ',');
  else if (argument.value.find('|') != std::string::npos)
    argument.choices = split(argument.value, '|');
  return argument;
}

}  // namespace

Verb command_tree(const CLI::App& app) {
  Verb verb{app.get_name(), app.get_description(), app.get_footer(), {}, {}};
  for (const auto* option : app.get_options([](const CLI::Option* one) { return !one->get_group().empty(); }))
    verb.arguments.push_back(argument_of(*option));
  for (const auto* child : app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); }))
    verb.verbs.push_back(command_tree(*child));
  return verb;
}

Offer offer_for(const Argument& argument) {
  if (!argument.choices.empty()) return Offer::words;
  if (argument.value == "EXP") return Offer::experiment;
  if (argument.value == "FILE" || argument.value == "PATH") return Offer::file;
  if (argument.value == "DIR") return Offer::folder;
  if (argument.value == "NAME") return Offer::names;
  if (argument.value == "MECHANISMS") return Offer::mechanisms;
  return Offer::nothing;
}

}  // namespace tunica::app
