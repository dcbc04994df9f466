// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace tunica::plugins {

/// Whether nobody but root, the user and the owner of this program can change the file: neither it nor its folder, nor
/// a folder above (as given, and after symbolic links). Of the folders above, one that all may write to is fine where
/// it is sticky, as /tmp is. A group counts as others, unless it is the private group of the owner (of the same name,
/// without other members). Returns an empty text, or what was found, expected, and what to do.
std::string distrust(const std::filesystem::path& file);

}  // namespace tunica::plugins
