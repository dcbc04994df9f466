// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "answer.hpp"
#include "data/nearest.hpp"
#include "exit_codes.hpp"
#include "plugins/description.hpp"
#include "results/keys.hpp"
#include "text/wrapping.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace key = results::key;

namespace {

const std::string& doc_of(const MechanismFactory& factory) { return factory.cause; }
template <class Factory>
const std::string& doc_of(const Factory& factory) {
  return factory.doc;
}

struct ListOptions {
  std::string what;
  bool names = false, as_json = false;
};

template <class Shelf>
void print_shelf(const std::string& title, const Shelf& shelf, const ListOptions& options,
                 nlohmann::ordered_json& document) {
  if (!options.what.empty() && options.what != title) return;
  if (options.as_json) {
    auto& list = document[title] = nlohmann::ordered_json::array();
    for (const auto& [name, entry] : shelf)
      list.push_back({{key::name, name},
                      {key::doc, doc_of(entry.factory)},
                      {key::reference, entry.factory.reference},
                      {key::plugin, entry.plugin}});
    return;
  }
  if (!options.names) answer("{} ({})\n", title, shelf.size());
  std::size_t width = 0;
  for (const auto& [name, entry] : shelf) width = std::max(width, name.size());
  for (const auto& [name, entry] : shelf)
    if (options.names)
      answer("{}\n", name);
    else
      answer("{}\n", text::hanging(fmt::format("  {:<{}}  ", name, width),
                                   fmt::format("{} [{}]", doc_of(entry.factory), entry.plugin)));
}

int list(const GlobalOptions& global, const ListOptions& options) {
  const std::vector<std::string> shelves = {"models", "tests", "optimizers", "mechanisms"};
  const auto& what = options.what;
  if (!what.empty() && std::find(shelves.begin(), shelves.end(), what) == shelves.end())
    throw InputError(fmt::format("there is nothing called '{}' to list. {}", what, data::suggestion(what, shelves)));
  const Session session(global);
  const auto& catalogue = session.catalogue();
  nlohmann::ordered_json document;
  print_shelf("models", catalogue.models(), options, document);
  print_shelf("tests", catalogue.tests(), options, document);
  print_shelf("optimizers", catalogue.optimizers(), options, document);
  print_shelf("mechanisms", catalogue.mechanisms(), options, document);
  if (!options.as_json) return done;
  auto& plugins = document[key::plugins] = nlohmann::ordered_json::array();
  for (const auto& one : session.loaded())
    plugins.push_back({{key::name, one.name}, {key::version, one.version}, {key::file, one.file.string()}});
  document[key::refused] = session.refusals();
  print_json(document);
  return done;
}

}  // namespace

void add_list(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<ListOptions>();
  auto* verb = app.add_subcommand("list", "List what the loaded plugins provide");
  verb->add_option("what", options->what, "models, tests, optimizers or mechanisms (default: everything)")
      ->type_name("models|tests|optimizers|mechanisms");
  verb->add_flag("--names", options->names, "Print only the names, one a line");
  verb->add_flag("--json", options->as_json, "Print one JSON object, with the plugins and those that were refused");
  verb->footer(
      "Examples:\n  tunica list\n  tunica list models\n  tunica list optimizers --plugin-path my_plugins\n"
      "  tunica list mechanisms --json | jq '.mechanisms[].name'");
  verb->callback([&global, &action, options] { action = [&global, options] { return list(global, *options); }; });
}

}  // namespace tunica::app
