// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "answer.hpp"
#include "data/nearest.hpp"
#include "execution/files.hpp"
#include "exit_codes.hpp"
#include "plugin.hpp"
#include "templates.hpp"
#include "tunica/error.hpp"

namespace tunica::app {

namespace {

namespace fs = std::filesystem;

struct New {
  std::string kind, name, folder;
};

/// "grip_compliance" → "GripCompliance"
std::string pascal_case(const std::string& name) {
  std::string text;
  bool upper = true;
  for (const char character : name) {
    if (character == '_') {
      upper = true;
      continue;
    }
    text += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(character))) : character;
    upper = false;
  }
  return text;
}

/// The example's name, as a whole word, and where a class begins with it: "DemirayLaw", but not the author Demiray.
std::string renamed(const std::string& text, const std::string& example, const std::string& name) {
  const std::regex word("\\b" + example + "\\b"), class_name("\\b" + pascal_case(example) + "(?=[A-Z])");
  return std::regex_replace(std::regex_replace(text, word, name), class_name, pascal_case(name));
}

void check_name(const std::string& name, const plugins::Catalogue& catalogue) {
  if (!std::regex_match(name, std::regex("[a-z][a-z0-9]*(_[a-z0-9]+)*")))
    throw InputError(fmt::format(
        "'{}' cannot name a plugin; expected lower-case letters, digits and single underscores, beginning with a "
        "letter, such as 'my_model': it becomes a file, a target and the \"type\" in experiments",
        name));
  const bool taken = catalogue.models().count(name) + catalogue.tests().count(name) +
                         catalogue.optimizers().count(name) + catalogue.mechanisms().count(name) >
                     0;
  if (taken)
    throw InputError(
        fmt::format("'{}' is provided by a loaded plugin, see `tunica describe {}`; choose another name", name, name));
}

int begin_plugin(const GlobalOptions& global, const New& wanted) {
  std::vector<std::string> kinds;
  for (const TemplateFile& file : template_files())
    if (kinds.empty() || kinds.back() != file.kind) kinds.emplace_back(file.kind);
  if (std::find(kinds.begin(), kinds.end(), wanted.kind) == kinds.end())
    throw InputError(
        fmt::format("there is no kind of plugin called '{}'. {}", wanted.kind, data::suggestion(wanted.kind, kinds)));
  const Session session(global);
  check_name(wanted.name, session.catalogue());
  const fs::path folder = wanted.folder.empty() ? fs::path(wanted.name) : fs::path(wanted.folder);
  if (fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder)))
    throw InputError(
        fmt::format("{} exists and is not empty; nothing was written; name another folder with -o", folder.string()));
  execution::make_folder(folder);
  answer("{}: a {} that builds and passes as it stands\n", folder.string(), wanted.kind);
  for (const TemplateFile& file : template_files()) {
    if (file.kind != wanted.kind) continue;
    const std::string example(file.example);
    const fs::path path = folder / renamed(std::string(file.path), example, wanted.name);
    execution::write_atomically(path, renamed(std::string(file.text), example, wanted.name));
    answer("  {}\n", path.string());
  }
  const std::string build = (folder / "build").string(), plugin = fmt::format("{}/{}.so", build, wanted.name);
  answer(
      "\nNext:\n  cmake -S {0} -B {1}\n  cmake --build {1}\n  tunica plugin check {2}\n"
      "  tunica --plugin-path {2} {3} {0}/experiment.json\n{0}/README.md says what to change.\n",
      folder.string(), build, plugin, wanted.kind == "mechanism" ? "diagnose" : "run");
  return done;
}

}  // namespace

void add_plugin_new(CLI::App& plugin, GlobalOptions& global, Action& action) {
  auto wanted = std::make_shared<New>();
  auto* verb = plugin.add_subcommand("new", "Write a project for a new plugin: source, build, test, example");
  verb->add_option("kind", wanted->kind, "model, test, optimizer or mechanism")->required();
  verb->add_option("name", wanted->name, "Name of the type in experiments: my_model")->required();
  verb->add_option("-o,--output", wanted->folder, "Folder of the project (default: NAME)")->type_name("DIR");
  verb->footer(
      "Examples:\n  tunica plugin new model my_model\n  tunica plugin new mechanism my_effect -o plugins/my_effect");
  verb->callback([&global, &action, wanted] { action = [&global, wanted] { return begin_plugin(global, *wanted); }; });
}

}  // namespace tunica::app
