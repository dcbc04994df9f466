// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace tunica::data {

constexpr std::size_t largest_file = std::size_t{1} << 30;  ///< bytes of a data file

/// The bytes of a regular file of at most `most` bytes; throws InputError. Never waits: a pipe, a device or a file of
/// /proc is refused, and nothing is read from it.
std::string read_bytes(const std::filesystem::path& file, std::size_t most = largest_file);

}  // namespace tunica::data
