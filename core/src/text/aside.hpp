// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <utility>

#include <fmt/format.h>

namespace tunica::text {

/// Prints on stderr. Where it cannot be written, because a disk is full or nobody listens, the words are lost and
/// nothing else: work does not end for want of a progress line.
template <class... Values>
void aside(fmt::format_string<Values...> form, Values&&... values) {
  const std::string words = fmt::format(form, std::forward<Values>(values)...);
  std::fwrite(words.data(), 1, words.size(), stderr);
}

}  // namespace tunica::text
