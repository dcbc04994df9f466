// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plugins/catalogue.hpp"

namespace tunica::plugins {

struct SearchPath {
  std::vector<std::filesystem::path> folders;  ///< searched in this order: --plugin-path, TUNICA_PLUGIN_PATH, install
  bool allow_world_writable = false;
};

struct LoadedPlugin {
  std::string name, version;
  std::filesystem::path file;
};

/// A plugin that was not taken: what was expected, what was found, what to do.
struct RefusedPlugin {
  std::filesystem::path file;
  std::string reason;
};

struct LoadReport {
  std::vector<LoadedPlugin> loaded;
  std::vector<RefusedPlugin> refused;
};

/// --plugin-path folders, then TUNICA_PLUGIN_PATH (colon-separated), then the folder beside the executable
/// (../<libdir>/tunica/plugins, as built and as installed).
SearchPath default_search_path(const std::vector<std::filesystem::path>& from_command_line);
/// The same with a folder of a library that is no part of that executable, in place of the last one.
SearchPath search_path(const std::vector<std::filesystem::path>& named, const std::filesystem::path& installed);

/// Loads every plugin of the path, in path order and by file name within a folder; a bad one is refused with its
/// reason while the others load. Libraries stay mapped for the life of the process.
LoadReport load_all(const SearchPath& path, Catalogue& catalogue);

/// Loads one file; returns its name and version, or throws LoadError.
struct LoadError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
LoadedPlugin load_file(const std::filesystem::path& file, Catalogue& catalogue, bool allow_world_writable = false);

}  // namespace tunica::plugins
