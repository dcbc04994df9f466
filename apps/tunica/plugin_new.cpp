// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
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
#include "plugin_like.hpp"
#include "renamed.hpp"
#include "templates.hpp"
#include "tunica/error.hpp"

namespace tunica::app {

namespace {

namespace fs = std::filesystem;

struct New {
  std::string kind, name, folder, like;
};

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

std::vector<ProjectFile> files_of_example(const std::string& kind, const std::string& name) {
  std::vector<ProjectFile> files;
  for (const TemplateFile& file : template_files())
    if (const std::string example(file.example); file.kind == kind)
      files.push_back({renamed(std::string(file.path), example, name), renamed(std::string(file.text), example, name)});
  return files;
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
  const bool copied = !wanted.like.empty();
  const std::vector<ProjectFile> files = copied ? files_like(wanted.kind, wanted.like, wanted.name, session.catalogue())
                                                : files_of_example(wanted.kind, wanted.name);
  const fs::path folder = wanted.folder.empty() ? fs::path(wanted.name) : fs::path(wanted.folder);
  if (fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder)))
    throw InputError(
        fmt::format("{} exists and is not empty; nothing was written; name another folder with -o", folder.string()));
  execution::make_folder(folder);
  answer("{}: a {} that builds and passes as it stands\n", folder.string(), wanted.kind);
  for (const ProjectFile& file : files) {
    execution::write_atomically(folder / file.path, file.text);
    answer("  {}\n", (folder / file.path).string());
  }
  const std::string build = (folder / "build").string(), plugin = fmt::format("{}/{}.so", build, wanted.name);
  const bool has_example =
      std::any_of(files.begin(), files.end(), [](const ProjectFile& file) { return file.path == "experiment.json"; });
  const std::string last = has_example ? fmt::format("  tunica --plugin-path {} {} {}/experiment.json\n", plugin,
                                                     wanted.kind == "mechanism" ? "diagnose" : "run", folder.string())
                                       : fmt::format("  tunica --plugin-path {} describe {}\n", plugin, wanted.name);
  answer(
      "\nNext:\n  cmake -S {0} -B {1}\n  cmake --build {1}\n  tunica plugin check {2}\n"
      "{3}{0}/README.md says what to change.\n",
      folder.string(), build, plugin, last);
  return done;
}

}  // namespace

void add_plugin_new(CLI::App& plugin, GlobalOptions& global, Action& action) {
  auto wanted = std::make_shared<New>();
  auto* verb = plugin.add_subcommand("new", "Write a project for a new plugin: source, build, test, example");
  verb->add_option("kind", wanted->kind, "model, test, optimizer or mechanism")->required();
  verb->add_option("name", wanted->name, "Name of the type in experiments: my_model")->required();
  verb->add_option("-o,--output", wanted->folder, "Folder of the project (default: NAME)")->type_name("DIR");
  verb->add_option("--like", wanted->like, "Begin with a copy of this built-in model, test or optimizer")
      ->type_name("TYPE");
  verb->footer(
      "Examples:\n  tunica plugin new model my_model\n  tunica plugin new model my_model --like gho\n"
      "  tunica plugin new mechanism my_effect -o plugins/my_effect");
  verb->callback([&global, &action, wanted] { action = [&global, wanted] { return begin_plugin(global, *wanted); }; });
}

}  // namespace tunica::app
