// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace tunica::app {

/// One file of the worked example that a new plugin of a kind begins with (examples/plugins, embedded by
/// templates.cmake).
struct TemplateFile {
  std::string_view kind;     ///< "model", "test", "optimizer", "mechanism"
  std::string_view example;  ///< the name that the new one's takes the place of: "demiray"
  std::string_view path;     ///< in the project: "demiray.cpp"
  std::string_view text;
};

std::span<const TemplateFile> template_files();

/// The sources of the built-in plugins that `plugin new --like` copies: those that need no more than the SDK and what
/// Debian has. `example` is the type.
std::span<const TemplateFile> built_in_files();

}  // namespace tunica::app
