// SPDX-License-Identifier: Apache-2.0
#include "plugins/refusals.hpp"

#include <fstream>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "plugins/elf_extent.hpp"
#include "plugins/trust.hpp"

namespace tunica::plugins {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view rebuild = "rebuild the plugin with the headers and the compiler of this tunica";

/// "eigen 3.4.0; alignment 16" → {eigen: 3.4.0, alignment: 16}, in the order of the text.
std::vector<std::pair<std::string, std::string>> fields_of(std::string_view fingerprint) {
  constexpr std::string_view separator = "; ";
  std::vector<std::pair<std::string, std::string>> fields;
  while (!fingerprint.empty()) {
    const std::size_t end = fingerprint.find(separator);
    const std::string_view field = fingerprint.substr(0, end);
    const std::size_t blank = field.find(' ');
    fields.emplace_back(field.substr(0, blank), blank == std::string_view::npos ? "" : field.substr(blank + 1));
    fingerprint.remove_prefix(end == std::string_view::npos ? fingerprint.size() : end + separator.size());
  }
  return fields;
}

/// Only the fields that differ: "eigen: expected 3.4.0, found 3.3.9".
std::string difference(std::string_view expected, std::string_view found) {
  const auto theirs_in_order = fields_of(found);
  std::map<std::string, std::string> theirs(theirs_in_order.begin(), theirs_in_order.end());
  std::string text;
  const auto tell = [&text](std::string_view key, std::string_view want, std::string_view have) {
    text += fmt::format("{}{}: expected {}, found {}", text.empty() ? "" : "; ", key, want, have);
  };
  for (const auto& [key, value] : fields_of(expected)) {
    const auto entry = theirs.find(key);
    if (entry == theirs.end()) {
      tell(key, value, "nothing");
    } else {
      if (entry->second != value) tell(key, value, entry->second);
      theirs.erase(entry);
    }
  }
  for (const auto& [key, value] : theirs) tell(key, "nothing", value);
  return text;
}

bool has_elf_signature(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  char signature[4] = {};
  stream.read(signature, sizeof signature);
  return stream && std::string_view(signature, sizeof signature) ==
                       "\x7f"
                       "ELF";
}

}  // namespace

std::string refuse_file(const fs::path& file, bool allow_world_writable) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) return "no such file; expected a plugin (a shared library); check the path";
  if (!fs::is_regular_file(status)) return "found something other than a regular file; expected a shared library";
  if (allow_world_writable) return {};
  return distrust(file);
}

std::string refuse_truncated(const fs::path& file) {
  const ElfExtent extent = elf_extent(file);
  if (!extent.elf || extent.complete()) return {};
  return fmt::format(
      "the file is cut short: it has {} bytes, and its headers speak of {}; expected a whole shared library; copy or "
      "build it again",
      extent.found, extent.needed);
}

std::string refuse_header(const PluginHeader* header) {
  if (header == nullptr) {
    return "tunica_plugin() returned a null pointer; expected the plugin's header; define it with TUNICA_PLUGIN()";
  }
  if (header->struct_size != sizeof(PluginHeader)) {
    return fmt::format("its header has {} bytes; expected {}; {}", header->struct_size, sizeof(PluginHeader), rebuild);
  }
  if (header->api != TUNICA_PLUGIN_API) {
    return fmt::format("it was built for plugin API {}; expected {}; {}", header->api, TUNICA_PLUGIN_API, rebuild);
  }
  constexpr std::string_view ours = TUNICA_ABI_FINGERPRINT;
  const std::string_view theirs = header->fingerprint == nullptr ? "" : header->fingerprint;
  if (theirs != ours) {
    const std::string fields = difference(ours, theirs);
    return fmt::format("its binary interface differs: {}; {}",
                       fields.empty() ? fmt::format("expected '{}', found '{}'", ours, theirs) : fields, rebuild);
  }
  for (const auto& [text, what] : {std::pair{header->name, "name"}, std::pair{header->version, "version"}}) {
    if (text == nullptr || *text == '\0') {
      return fmt::format("its header has no {0}; expected a text; give TUNICA_PLUGIN() a {0}", what);
    }
  }
  if (header->register_into == nullptr) {
    return fmt::format("plugin '{} {}' has no register function; expected one; define the plugin with TUNICA_PLUGIN()",
                       header->name, header->version);
  }
  return {};
}

std::string explain_load_failure(const fs::path& file, const std::string& linker_message) {
  if (!std::ifstream(file, std::ios::binary)) return "the file cannot be read; check its permissions";
  if (!has_elf_signature(file)) {
    return "not a shared library: it does not begin with the ELF signature; expected the plugin's compiled .so file";
  }
  constexpr std::string_view marker = "undefined symbol: ";
  if (const std::size_t at = linker_message.find(marker); at != std::string::npos) {
    const std::string symbol = linker_message.substr(at + marker.size());
    return fmt::format(
        "it needs the symbol '{}', which neither it nor a library it is linked with defines; link the "
        "missing library, and build with -Wl,-z,defs to see such gaps at link time",
        symbol.substr(0, symbol.find_first_of(" \t(,)")));
  }
  return fmt::format(
      "the dynamic linker refused it: {}; expected a shared library for this machine with all its "
      "dependencies installed",
      linker_message);
}

}  // namespace tunica::plugins
