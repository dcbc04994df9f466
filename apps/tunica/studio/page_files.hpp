// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace tunica::app::studio {

/// The page: files of studio/page, written into a source by embed.cmake.
struct PageFile {
  std::string_view name, type, text;
};
std::span<const PageFile> page_files();

}  // namespace tunica::app::studio
