// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

namespace tunica::plugins {

/// Bytes that an ELF file has, and that its own header, segments and sections say it has.
struct ElfExtent {
  bool elf = false;  ///< begins as an ELF file of this machine's word size does
  std::uint64_t found = 0, needed = 0;

  /// A truncated library would still be mapped, and access to the missing pages would kill the process (SIGBUS).
  [[nodiscard]] bool complete() const { return found >= needed; }
};

ElfExtent elf_extent(const std::filesystem::path& file);

}  // namespace tunica::plugins
