// SPDX-License-Identifier: Apache-2.0
#include "part.hpp"

#include <filesystem>

#include <dlfcn.h>
#include <fmt/core.h>
#include <sys/stat.h>

#include "tunica/error.hpp"

namespace tunica::pagmo_plugin {
namespace {

using Make = decltype(&tunica_pagmo_search);

/// Whether nobody can have written the file who could not have written this plugin.
bool as_safe_as(const std::filesystem::path& plugin, const std::filesystem::path& file) {
  struct stat of_plugin {
  }, of_file{};
  if (::stat(plugin.c_str(), &of_plugin) != 0 || ::stat(file.c_str(), &of_file) != 0) return true;  // dlopen says why
  constexpr mode_t others = S_IWGRP | S_IWOTH;
  return of_file.st_uid == of_plugin.st_uid && (of_file.st_mode & others & ~of_plugin.st_mode) == 0;
}

/// The file lies beside this plugin. Like a plugin, it is never unmapped.
Make load() {
  Dl_info here{};
  ::dladdr(reinterpret_cast<const void*>(&load), &here);
  const auto plugin = std::filesystem::absolute(here.dli_fname);
  auto file = plugin;
  file.replace_filename("pagmo.search");
  if (!as_safe_as(plugin, file))
    throw InputError(
        fmt::format("the plugin pagmo does not load {}, which more users may write than pagmo.so; expected the same "
                    "owner and mode; install tunica again, or mend them with chown and chmod",
                    file.string()));
  void* part = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  void* make = part == nullptr ? nullptr : ::dlsym(part, "tunica_pagmo_search");
  if (make == nullptr)
    throw InputError(
        fmt::format("the plugin pagmo cannot load its second file ({}); expected pagmo.search of the same build beside "
                    "pagmo.so; copy both, or install tunica again",
                    ::dlerror()));
  return reinterpret_cast<Make>(make);
}

}  // namespace

std::unique_ptr<Optimizer> search_with(Method method, const Options& given) {
  static const Make make = load();
  return std::unique_ptr<Optimizer>(make(method, given));
}

}  // namespace tunica::pagmo_plugin
