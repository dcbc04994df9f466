// SPDX-License-Identifier: Apache-2.0
#include "part.hpp"

#include <filesystem>

#include <dlfcn.h>
#include <fmt/core.h>

#include "tunica/error.hpp"

namespace tunica::pagmo_plugin {
namespace {

using Make = decltype(&tunica_pagmo_search);

/// The file lies beside this plugin. Like a plugin, it is never unmapped.
Make load() {
  Dl_info here{};
  ::dladdr(reinterpret_cast<const void*>(&load), &here);
  const auto file = std::filesystem::absolute(here.dli_fname).replace_filename("pagmo.search");
  void* part = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  void* make = part == nullptr ? nullptr : ::dlsym(part, "tunica_pagmo_search");
  if (make == nullptr)
    throw InputError(
        fmt::format("the plugin pagmo cannot load its second file ({}); expected pagmo.search of the same build beside "
                    "pagmo.so; copy "
                    "both, or install tunica again",
                    ::dlerror()));
  return reinterpret_cast<Make>(make);
}

}  // namespace

std::unique_ptr<Optimizer> search_with(Method method, const Options& given) {
  static const Make make = load();
  return std::unique_ptr<Optimizer>(make(method, given));
}

}  // namespace tunica::pagmo_plugin
