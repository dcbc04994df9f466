// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "text/escaped.hpp"

namespace tunica::text {

/// Prints on stderr, codes for the terminal too. If it cannot be written, because a disk is full or the reader is gone,
/// the words are lost and nothing else: work does not end for want of a progress line.
inline void aside_raw(std::string_view words) { std::fwrite(words.data(), 1, words.size(), stderr); }

/// The same, escaped: names and paths of others may be among the words.
template <class... Values>
void aside(fmt::format_string<Values...> form, Values&&... values) {
  aside_raw(escaped(fmt::format(form, std::forward<Values>(values)...), "\n"));
}

}  // namespace tunica::text
