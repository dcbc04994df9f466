// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "tunica/plugin.hpp"

/// The checks before a plugin's code is trusted. Each returns an empty text, or what was expected, what was found
/// and what to do.
namespace tunica::plugins {

/// The file exists, is a regular file, and no other user can change it, see trust.hpp.
std::string refuse_file(const std::filesystem::path& file, bool allow_world_writable);

/// An ELF file has all the bytes that its headers speak of; to map one that has not would end the process.
std::string refuse_truncated(const std::filesystem::path& file);

/// The fields of the header in the order in which they may be read: the size says whether the rest is there, the API
/// number what the rest means, the fingerprint whether C++ objects can cross.
std::string refuse_header(const PluginHeader* header);

/// Why the dynamic linker could not map the file, from its own text.
std::string explain_load_failure(const std::filesystem::path& file, const std::string& linker_message);

}  // namespace tunica::plugins
