// SPDX-License-Identifier: Apache-2.0
#include "plugins/elf_extent.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

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
bool read_at(std::ifstream& stream, std::uint64_t offset, std::span<Entry> entries) {
  static_assert(std::is_trivially_copyable_v<Entry>);
  stream.clear();
  stream.seekg(static_cast<std::streamoff>(offset));
  stream.read(reinterpret_cast<char*>(entries.data()), static_cast<std::streamsize>(entries.size_bytes()));
  return static_cast<bool>(stream);
}

/// A table of the file; none where its entries have another size. Plugins are many, and a table is read at once.
template <class Entry>
std::vector<Entry> table(std::ifstream& stream, std::uint64_t offset, std::size_t count, std::size_t size) {
  std::vector<Entry> entries(size == sizeof(Entry) ? count : 0);
  if (!read_at(stream, offset, std::span<Entry>(entries))) entries.clear();
  return entries;
}

}  // namespace

ElfExtent elf_extent(const std::filesystem::path& file) {
  ElfExtent extent;
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) return extent;
  extent.found = static_cast<std::uint64_t>(stream.tellg());
  unsigned char signature[EI_NIDENT] = {};
  constexpr unsigned char word = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  if (!read_at(stream, 0, std::span<unsigned char>(signature)) || std::memcmp(signature, ELFMAG, SELFMAG) != 0 ||
      signature[EI_CLASS] != word)
    return extent;  // not for this check: the dynamic linker says what it is
  extent.elf = true;
  extent.needed = sizeof(ElfW(Ehdr));
  ElfW(Ehdr) header;
  if (!read_at(stream, 0, std::span<ElfW(Ehdr)>(&header, 1))) return extent;
  const auto need = [&extent](std::uint64_t begin, std::uint64_t size) {
    extent.needed = std::max(extent.needed, end_of(begin, size));
  };
  need(header.e_phoff, std::uint64_t{header.e_phnum} * header.e_phentsize);
  need(header.e_shoff, std::uint64_t{header.e_shnum} * header.e_shentsize);
  if (!extent.complete()) return extent;
  for (const auto& segment : table<ElfW(Phdr)>(stream, header.e_phoff, header.e_phnum, header.e_phentsize))
    need(segment.p_offset, segment.p_filesz);
  for (const auto& section : table<ElfW(Shdr)>(stream, header.e_shoff, header.e_shnum, header.e_shentsize))
    if (section.sh_type != SHT_NOBITS && section.sh_type != SHT_NULL) need(section.sh_offset, section.sh_size);
  return extent;
}

}  // namespace tunica::plugins
