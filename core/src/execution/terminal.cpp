// SPDX-License-Identifier: Apache-2.0
#include "execution/terminal.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace tunica::execution {

namespace {

constexpr std::size_t shortest_bar = 5, longest_bar = 30, narrowest = 20;  // columns

bool continues_a_character(char c) { return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u; }

}  // namespace

Terminal Terminal::of(int descriptor) {
  Terminal terminal;
  const char* kind = std::getenv("TERM");
  const char* no_colour = std::getenv("NO_COLOR");
  terminal.redraws = ::isatty(descriptor) == 1 && kind && *kind && std::string_view(kind) != "dumb";
  terminal.colours = terminal.redraws && !(no_colour && *no_colour);
  winsize size{};
  if (::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col >= narrowest) terminal.columns = size.ws_col;
  return terminal;
}

std::size_t shown_columns(std::string_view text) {
  return text.size() - static_cast<std::size_t>(std::count_if(text.begin(), text.end(), continues_a_character));
}

std::string shortened(std::string_view text, std::size_t columns) {
  std::string shown(text);
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  if (shown_columns(shown) <= columns) return shown;
  if (columns == 0) return {};
  std::size_t end = 0, used = 0;
  while (end < shown.size() && (used < columns - 1 || continues_a_character(shown[end])))
    used += !continues_a_character(shown[end++]);
  return shown.substr(0, end) + "…";
}

void StatusLine::draw(const std::string& line, double share) const {
  const std::size_t used = shown_columns(line);
  std::string text = shortened(line, room());
  if (used + 3 + shortest_bar <= room()) {
    const std::size_t length = std::min(room() - used - 3, longest_bar);
    const double full = std::clamp(share, 0.0, 1.0) * static_cast<double>(length);
    const auto marks = static_cast<std::size_t>(std::lround(full));
    text = fmt::format("[{}{}{}{}] {}", terminal_.colours ? "\033[36m" : "", std::string(marks, '#'),
                       std::string(length - marks, '.'), terminal_.colours ? "\033[0m" : "", text);
  }
  fmt::print(stderr, "\r{}\033[K", text);
  std::fflush(stderr);
}

void StatusLine::clear() const {
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
}

}  // namespace tunica::execution
