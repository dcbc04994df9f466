// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plugins/catalogue.hpp"

namespace tunica::app {

/// One file of a new plugin's project.
struct ProjectFile {
  std::string path, text;
};

/// The project of a plugin that begins with the sources of the built-in one `like`, under the name `name`. Throws
/// InputError for what cannot be copied, with a list of what can.
std::vector<ProjectFile> files_like(const std::string& kind, const std::string& like, const std::string& name,
                                    const plugins::Catalogue& catalogue);

}  // namespace tunica::app
