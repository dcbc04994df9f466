// SPDX-License-Identifier: Apache-2.0
#include "plugin_like.hpp"

#include <algorithm>
#include <regex>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "data/nearest.hpp"
#include "renamed.hpp"
#include "templates.hpp"
#include "tunica/error.hpp"

namespace tunica::app {
namespace {

/// What a built-in plugin is linked with besides the SDK.
struct Needs {
  std::string packages, libraries;
};
Needs needs_of(std::string_view name) {
  if (name == "es")
    return {"find_package(fmt REQUIRED)\nfind_package(Boost REQUIRED)\n",
            " LIBRARIES fmt::fmt-header-only Boost::headers"};
  return {};
}

std::vector<std::string> copies_of(const std::string& kind) {
  std::vector<std::string> names;
  for (const TemplateFile& file : built_in_files())
    if (file.kind == kind && (names.empty() || names.back() != file.example)) names.emplace_back(file.example);
  return names;
}

bool is_loaded(const std::string& name, const plugins::Catalogue& catalogue) {
  return catalogue.models().contains(name) || catalogue.tests().contains(name) ||
         catalogue.optimizers().contains(name) || catalogue.mechanisms().contains(name);
}

void refuse_what_cannot_be_copied(const std::string& kind, const std::string& like,
                                  const plugins::Catalogue& catalogue) {
  const std::vector<std::string> names = copies_of(kind);
  if (std::find(names.begin(), names.end(), like) != names.end()) return;
  if (names.empty())
    throw InputError(
        fmt::format("--like {}: a {} cannot be copied; leave --like out, and the project begins with a "
                    "worked example",
                    like, kind));
  for (const char* other : {"model", "test", "optimizer"}) {
    const std::vector<std::string> others = copies_of(other);
    if (std::find(others.begin(), others.end(), like) != others.end())
      throw InputError(
          fmt::format("--like {0}: it is no {1}; write `tunica plugin new {2} NAME --like {0}`, or copy "
                      "one of {3}",
                      like, kind, other, fmt::join(names, ", ")));
  }
  if (is_loaded(like, catalogue))
    throw InputError(
        fmt::format("--like {}: it cannot be copied, since its source needs more than the SDK or is not "
                    "tunica's own; take one of the {}s {}",
                    like, kind, fmt::join(names, ", ")));
  throw InputError(
      fmt::format("--like {}: there is no such {} to copy. {}", like, kind, data::suggestion(like, names)));
}

/// The data and the experiment of the worked example of a kind; those of tests fit no other test.
std::vector<ProjectFile> example_with(const std::string& kind, const std::string& name) {
  std::vector<ProjectFile> files;
  if (kind == "test") return files;
  for (const TemplateFile& file : template_files())
    if (file.kind == kind && (file.path.ends_with(".csv") || file.path.ends_with(".json")))
      files.push_back({std::string(file.path), renamed(std::string(file.text), std::string(file.example), name)});
  return files;
}

std::string build_rules(const std::string& like, const std::string& name, const std::vector<std::string>& sources,
                        bool has_example) {
  const Needs needs = needs_of(like);
  return fmt::format(R"(# SPDX-License-Identifier: Apache-2.0
cmake_minimum_required(VERSION 3.25)
project({0} VERSION 1.0.0 LANGUAGES CXX)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
find_package(tunica 0.1 REQUIRED)
{1}
tunica_add_plugin({0} SOURCES {2}{3})
target_compile_definitions({0} PRIVATE TUNICA_PLUGIN_VERSION="${{PROJECT_VERSION}}")

# ctest: what every plugin of its kind has to hold{4}.
enable_testing()
tunica_test_plugin({0}{5})
)",
                     name, needs.packages, fmt::join(sources, " "), needs.libraries,
                     has_example ? ", and an example that uses it" : "",
                     has_example ? " EXPERIMENT experiment.json" : "");
}

std::string readme(const std::string& kind, const std::string& like, const std::string& name, bool has_example) {
  const std::string use = has_example ? fmt::format("tunica --plugin-path build/{}.so run experiment.json", name)
                                      : fmt::format("tunica --plugin-path build/{0}.so describe {0}", name);
  return fmt::format(R"(# {0}
A copy of tunica's {1} `{2}` under a name of its own, as a plugin to begin with.

```sh
cmake -S . -B build && cmake --build build      # -D CMAKE_PREFIX_PATH=<prefix> where tunica is not in /usr
ctest --test-dir build --output-on-failure      # conformance{3}
{4}
```

| file | what it is |
|---|---|
| `*.cpp`, `*.hpp` | the plugin: the sources of `{2}` with the name changed |
{5}
Both answer the same until you change something, so `{2}` is what to compare with. Change the sentences, the sources in the
literature and the table of parameters or options as well: help and reports show them.

A plugin in `lib/tunica/plugins` of the installation, or in a folder of `TUNICA_PLUGIN_PATH`, needs no `--plugin-path`.
`tunica describe {0}` shows what users see of it.
)",
                     name, kind, like, has_example ? ", and the example" : "", use,
                     has_example
                         ? "| `experiment.json`, `strip.csv` | an example that uses it; its data come from another "
                           "material |\n"
                         : "");
}

}  // namespace

std::vector<ProjectFile> files_like(const std::string& kind, const std::string& like, const std::string& name,
                                    const plugins::Catalogue& catalogue) {
  refuse_what_cannot_be_copied(kind, like, catalogue);
  std::vector<ProjectFile> files = example_with(kind, name);
  const bool has_example = !files.empty();
  std::vector<std::string> sources;
  for (const TemplateFile& file : built_in_files()) {
    if (file.kind != kind || file.example != like) continue;
    const std::string path = renamed(std::string(file.path), like, name);
    // The version is that of the new project.
    const std::regex version(R"((TUNICA_PLUGIN\("\w+",)\s"[^"]*"\))");
    files.push_back(
        {path, std::regex_replace(renamed(std::string(file.text), like, name), version, "$1 TUNICA_PLUGIN_VERSION)")});
    if (path.ends_with(".cpp")) sources.push_back(path);
  }
  files.push_back({"CMakeLists.txt", build_rules(like, name, sources, has_example)});
  files.push_back({"README.md", readme(kind, like, name, has_example)});
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

}  // namespace tunica::app
