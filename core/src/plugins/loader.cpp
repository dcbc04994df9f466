// SPDX-License-Identifier: Apache-2.0
#include "plugins/loader.hpp"

#define BOOST_DLL_USE_STD_FS
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <functional>
#include <new>
#include <set>
#include <string_view>
#include <utility>

#include <boost/dll/runtime_symbol_info.hpp>
#include <boost/dll/shared_library.hpp>
#include <dlfcn.h>
#include <fmt/format.h>

#include "plugins/guarded.hpp"
#include "plugins/images.hpp"
#include "plugins/refusals.hpp"
#include "plugins/usual_arithmetic.hpp"
#include "tunica/detail/vector_level.hpp"
#include "tunica/error.hpp"

namespace tunica::plugins {
namespace fs = std::filesystem;
namespace {

constexpr const char* entry_symbol = "tunica_plugin";

/// Maps the file for the life of the process. Objects, exceptions, vtables and type information of a plugin live in
/// its image, and a library can start threads or hand out pointers before anyone knows that it is no plugin: what was
/// mapped once is never unmapped, refused libraries included. The list itself is therefore never destroyed.
const boost::dll::shared_library& map_for_good(const fs::path& file) {
  static auto& mapped = *new std::vector<boost::dll::shared_library>();
  boost::dll::shared_library library;
  boost::dll::fs::error_code error;
  for (bool again : {true, false}) {
    dlerror();  // forget an older message
    library.load(fs::absolute(file), error, boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local);
    if (!error) break;
    // Boost says "Bad file descriptor" whatever happened; the linker's own text names the reason.
    const char* text = dlerror();
    if (again) continue;  // memory that lacked for a moment says nothing of the plugin
    throw LoadError(explain_load_failure(file, text == nullptr ? error.message() : text));
  }
  return mapped.emplace_back(std::move(library));
}

/// Runs code of the plugin and turns any exception into LoadError. After a lack of memory it tries once more: without
/// the plugin the work would go on to another result.
template <class Call>
auto shielded(std::string_view doing, const Call& call, bool again = true) {
  try {
    try {
      return call();
    } catch (const std::bad_alloc&) {
      if (!again) throw;
    }
    return shielded(doing, call, false);
  } catch (const std::exception& problem) {
    throw LoadError(fmt::format("{} failed: {}; expected it to return normally; nothing of the plugin was taken", doing,
                                problem.what()));
  } catch (...) {
    throw LoadError(
        fmt::format("{} threw something that is not a std::exception; expected it to return normally; nothing "
                    "of the plugin was taken",
                    doing));
  }
}

std::vector<fs::path> plugins_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == boost::dll::shared_library::suffix()) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

std::string refuse_folder(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::exists(status)) return "no such folder; expected a folder with plugins; check the plugin path";
  if (!fs::is_directory(status)) return "found a file; expected a folder with plugins; name the folder it lies in";
  return {};
}

}  // namespace

namespace {

/// What the user named, then TUNICA_PLUGIN_PATH.
SearchPath named_path(const std::vector<fs::path>& named) {
  SearchPath path{named};
  if (const char* variable = std::getenv("TUNICA_PLUGIN_PATH")) {
    std::string_view rest = variable;
    while (!rest.empty()) {
      const std::size_t colon = rest.find(':');
      if (colon != 0) path.folders.emplace_back(rest.substr(0, colon));
      rest.remove_prefix(colon == std::string_view::npos ? rest.size() : colon + 1);
    }
  }
  return path;
}

}  // namespace

SearchPath search_path(const std::vector<fs::path>& named, const fs::path& installed) {
  SearchPath path = named_path(named);
  // Nobody asked for the install folder by name, so its absence is no error.
  if (std::error_code error; fs::is_directory(installed, error)) path.folders.push_back(fs::canonical(installed));
  return path;
}

SearchPath default_search_path(const std::vector<fs::path>& from_command_line) {
  // Without any folder there is nothing to do.
  boost::dll::fs::error_code unknown;
  const fs::path program = boost::dll::program_location(unknown).string();
  if (!unknown) return search_path(from_command_line, program.parent_path() / TUNICA_PLUGINS_FROM_BIN);
  SearchPath path = named_path(from_command_line);
  if (path.folders.empty())
    throw InputError(fmt::format(
        "cannot find out where this program is ({}), and so not where its plugins are; mount /proc, or name "
        "their folder in TUNICA_PLUGIN_PATH or with --plugin-path",
        unknown.message()));
  return path;
}

void check_vector_level() {
  const char* const stated = std::getenv(detail::vector_level_variable);
  if (stated == nullptr) return;
  const auto level = detail::vector_level_called(stated);
  if (!level)
    throw InputError(fmt::format("{} is '{}'; expected baseline, avx2 or avx512, or leave the variable out",
                                 detail::vector_level_variable, stated));
  const auto best = detail::best_vector_level();
  if (*level > best)
    throw InputError(
        fmt::format("{} is '{}', which this machine or this build does not offer; the highest is '{}'. "
                    "Lower it, or leave the variable out",
                    detail::vector_level_variable, stated, detail::name(best)));
}

LoadReport load_all(const SearchPath& path, Catalogue& catalogue) {
  check_vector_level();
  LoadReport report;
  std::set<fs::path> searched;
  for (const fs::path& folder : path.folders) {
    if (std::string reason = refuse_folder(folder); !reason.empty()) {
      report.refused.push_back({folder, std::move(reason)});
      continue;
    }
    // A folder that the path names twice holds no duplicates.
    if (!searched.insert(fs::canonical(folder)).second) continue;
    try {
      for (const fs::path& file : plugins_in(folder)) {
        try {
          report.loaded.push_back(load_file(file, catalogue, path.allow_world_writable));
        } catch (const LoadError& refusal) {
          report.refused.push_back({file, refusal.what()});
        }
      }
    } catch (const fs::filesystem_error& problem) {
      report.refused.push_back(
          {folder, fmt::format("the folder cannot be read ({}); check its permissions", problem.code().message())});
    }
  }
  return report;
}

LoadedPlugin load_file(const fs::path& file, Catalogue& catalogue, bool allow_world_writable) {
  if (const std::string reason = refuse_file(file, allow_world_writable); !reason.empty()) throw LoadError(reason);
  if (const std::string reason = refuse_truncated(file); !reason.empty()) throw LoadError(reason);
  const UsualArithmetic kept;
  const std::string name = file.filename().string();
  const std::uint64_t input = std::hash<std::string>()(fs::absolute(file).string());
  const Call call{name.c_str(), "load", plain_key, &input};
  // What ended one process is loaded once more: memory may have lacked, and without the plugin the work would go on to
  // another result.
  if (casualties != nullptr && casualties->weight(name) > 1)
    if (const std::string reason = refusal(name, plain_key(call)); !reason.empty()) throw LoadError(reason);
  const CallScope scope(call);
  const boost::dll::shared_library& library = map_for_good(file);
  note_image(library.native(), name);
  if (!library.has(entry_symbol)) {
    throw LoadError(
        fmt::format("a shared library, but not a plugin: it exports no symbol '{}'; define the plugin with "
                    "TUNICA_PLUGIN(), or take the file out of the plugin path",
                    entry_symbol));
  }
  const auto entry = library.get<const PluginHeader*()>(entry_symbol);
  const PluginHeader* header = shielded("tunica_plugin()", [&] { return entry(); });
  if (const std::string reason = refuse_header(header); !reason.empty()) throw LoadError(reason);

  const std::string plugin = fmt::format("{} {}", header->name, header->version);
  note_image(library.native(), plugin);
  Catalogue::Registration registration = shielded(fmt::format("registration of plugin '{}'", plugin), [&] {
    Catalogue::Registration fresh;
    header->register_into(fresh);
    return fresh;
  });
  try {
    catalogue.commit(std::move(registration), plugin);
  } catch (const std::invalid_argument& problem) {
    throw LoadError(fmt::format("plugin '{}': {}", plugin, problem.what()));
  }
  return {header->name, header->version, file};
}

}  // namespace tunica::plugins
