// SPDX-License-Identifier: Apache-2.0
#include "plugins/images.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>

namespace tunica::plugins {

namespace {

struct Image {
  std::atomic<std::uintptr_t> begin = 0, end = 0;
  std::array<char, 96> plugin = {};
};

/// Filled while plugins are loaded, read by signal handlers: nothing in it moves. More plugins than this stay unnamed.
constexpr std::size_t most_images = 256;
std::array<Image, most_images> images;
std::atomic<std::size_t> count = 0;

/// The addresses of the library that was mapped at `base`.
struct Extent {
  std::uintptr_t base, begin = 0, end = 0;
};

int measure(dl_phdr_info* info, std::size_t, void* data) {
  auto& extent = *static_cast<Extent*>(data);
  if (info->dlpi_addr != extent.base) return 0;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& segment = info->dlpi_phdr[i];
    if (segment.p_type == PT_LOAD) extent.end = std::max(extent.end, extent.base + segment.p_vaddr + segment.p_memsz);
  }
  extent.begin = extent.base;
  return 1;
}

}  // namespace

void note_image(void* handle, const std::string& plugin) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  link_map* map = nullptr;
  if (handle == nullptr || ::dlinfo(handle, RTLD_DI_LINKMAP, &map) != 0) return;
  Extent extent{map->l_addr};
  ::dl_iterate_phdr(measure, &extent);
  std::size_t place = 0;
  while (place < count && images[place].begin != extent.begin) ++place;
  if (extent.end == 0 || place == images.size()) return;
  if (place == 0) {  // the first call of backtrace() loads a library, which a handler may not
    std::array<void*, 1> frame;
    static_cast<void>(::backtrace(frame.data(), 1));
  }
  Image& image = images[place];
  image.plugin.fill(0);
  plugin.copy(image.plugin.data(), image.plugin.size() - 1);
  image.begin = extent.begin;
  image.end = extent.end;
  count = std::max(count.load(), place + 1);
}

const char* plugin_at(const void* address) {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  for (std::size_t i = 0; i < count; ++i)
    if (at >= images[i].begin && at < images[i].end) return images[i].plugin.data();
  return nullptr;
}

const char* plugin_on_the_stack() {
  std::array<void*, 64> frames;
  const int depth = ::backtrace(frames.data(), static_cast<int>(frames.size()));
  for (int i = 0; i < depth; ++i)
    if (const char* plugin = plugin_at(frames[static_cast<std::size_t>(i)]); plugin != nullptr) return plugin;
  return nullptr;
}

}  // namespace tunica::plugins
