// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace tunica::external {

/// The program's file: found in PATH, or below `folder` where the name has a slash. Throws InputError.
std::filesystem::path program_file(const std::string& name, const std::filesystem::path& folder);

/// The last lines of a text file, joined by " | "; blank ones left out.
std::string last_lines(const std::filesystem::path& file, std::size_t count);

}  // namespace tunica::external
