// SPDX-License-Identifier: Apache-2.0
#include "execution/share.hpp"

#include <charconv>

#include <fmt/format.h>

#include "tunica/error.hpp"

namespace tunica::execution {

namespace {

constexpr std::size_t most_parts = 100000;

}  // namespace

Share parse_share(const std::string& text) {
  Share share{0, 0};
  const std::size_t slash = text.find('/');
  const auto number = [&text](std::size_t from, std::size_t to, std::size_t& value) {
    const char* end = text.data() + to;
    const auto [stopped, error] = std::from_chars(text.data() + from, end, value);
    return error == std::errc() && stopped == end;
  };
  if (slash == std::string::npos || !number(0, slash, share.part) || !number(slash + 1, text.size(), share.of) ||
      share.part < 1 || share.part > share.of || share.of > most_parts)
    throw InputError(
        fmt::format("--shard {}: expected k/N with 1 ≤ k ≤ N ≤ {}, for example 2/7 for the second of seven parts", text,
                    most_parts));
  return share;
}

}  // namespace tunica::execution
