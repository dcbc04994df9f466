// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "comparison/text.hpp"
#include "data/nearest.hpp"
#include "exit_codes.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

const std::string& doc_of(const MechanismFactory& factory) { return factory.cause; }
template <class Factory>
const std::string& doc_of(const Factory& factory) {
  return factory.doc;
}

template <class Shelf>
void print_shelf(const std::string& title, const Shelf& shelf) {
  fmt::print("{} ({})\n", title, shelf.size());
  std::size_t width = 0;
  for (const auto& [name, entry] : shelf) width = std::max(width, name.size());
  for (const auto& [name, entry] : shelf)
    fmt::print("{}\n", comparison::hanging(fmt::format("  {:<{}}  ", name, width),
                                           fmt::format("{} [{}]", doc_of(entry.factory), entry.plugin)));
}

int list(const GlobalOptions& global, const std::string& what) {
  const std::vector<std::string> shelves = {"models", "tests", "optimizers", "mechanisms"};
  if (!what.empty() && std::find(shelves.begin(), shelves.end(), what) == shelves.end())
    throw InputError(fmt::format("there is nothing called '{}' to list. {}", what, data::suggestion(what, shelves)));
  const Session session(global);
  const auto& catalogue = session.catalogue();
  if (what.empty() || what == "models") print_shelf("models", catalogue.models());
  if (what.empty() || what == "tests") print_shelf("tests", catalogue.tests());
  if (what.empty() || what == "optimizers") print_shelf("optimizers", catalogue.optimizers());
  if (what.empty() || what == "mechanisms") print_shelf("mechanisms", catalogue.mechanisms());
  return done;
}

}  // namespace

void add_list(CLI::App& app, GlobalOptions& global, Action& action) {
  auto what = std::make_shared<std::string>();
  auto* verb = app.add_subcommand("list", "List what the loaded plugins provide");
  verb->add_option("what", *what, "models, tests, optimizers or mechanisms; everything without it");
  verb->footer("Examples:\n  tunica list\n  tunica list models\n  tunica list optimizers --plugin-path my_plugins");
  verb->callback([&global, &action, what] { action = [&global, what] { return list(global, *what); }; });
}

}  // namespace tunica::app
