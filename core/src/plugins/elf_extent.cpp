// SPDX-License-Identifier: Apache-2.0
#include "plugins/elf_extent.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>
#include <type_traits>

#include <elf.h>
#include <link.h>

namespace tunica::plugins {

namespace {

constexpr std::uint64_t everything = std::numeric_limits<std::uint64_t>::max();

/// begin + size; an overflow needs more than any file has.
std::uint64_t end_of(std::uint64_t begin, std::uint64_t size) {
  return begin > everything - size ? everything : begin + size;
}

template <class Entry>
bool read_at(std::ifstream& stream, std::uint64_t offset, Entry& entry) {
  static_assert(std::is_trivially_copyable_v<Entry>);
  stream.clear();
  stream.seekg(static_cast<std::streamoff>(offset));
  stream.read(reinterpret_cast<char*>(&entry), sizeof entry);
  return static_cast<bool>(stream);
}

}  // namespace

ElfExtent elf_extent(const std::filesystem::path& file) {
  ElfExtent extent;
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) return extent;
  extent.found = static_cast<std::uint64_t>(stream.tellg());
  unsigned char signature[EI_NIDENT] = {};
  constexpr unsigned char word = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  if (!read_at(stream, 0, signature) || std::memcmp(signature, ELFMAG, SELFMAG) != 0 || signature[EI_CLASS] != word)
    return extent;  // not for this check: the dynamic linker says what it is
  extent.elf = true;
  extent.needed = sizeof(ElfW(Ehdr));
  ElfW(Ehdr) header;
  if (!read_at(stream, 0, header)) return extent;
  const auto need = [&extent](std::uint64_t begin, std::uint64_t size) {
    extent.needed = std::max(extent.needed, end_of(begin, size));
  };
  need(header.e_phoff, std::uint64_t{header.e_phnum} * header.e_phentsize);
  need(header.e_shoff, std::uint64_t{header.e_shnum} * header.e_shentsize);
  if (!extent.complete()) return extent;
  for (std::uint64_t i = 0; i < header.e_phnum && header.e_phentsize == sizeof(ElfW(Phdr)); ++i) {
    ElfW(Phdr) segment;
    if (!read_at(stream, header.e_phoff + i * sizeof segment, segment)) return extent;
    need(segment.p_offset, segment.p_filesz);
  }
  for (std::uint64_t i = 0; i < header.e_shnum && header.e_shentsize == sizeof(ElfW(Shdr)); ++i) {
    ElfW(Shdr) section;
    if (!read_at(stream, header.e_shoff + i * sizeof section, section)) return extent;
    if (section.sh_type != SHT_NOBITS && section.sh_type != SHT_NULL) need(section.sh_offset, section.sh_size);
  }
  return extent;
}

}  // namespace tunica::plugins
