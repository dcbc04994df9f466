// SPDX-License-Identifier: Apache-2.0
#include "text/terminal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "text/aside.hpp"
#include "text/wrapping.hpp"

namespace tunica::text {

namespace {

constexpr std::size_t shortest_bar = 5, longest_bar = 30, narrowest = 20;  // columns

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

std::string clock_text(double seconds) {
  const auto whole = static_cast<long>(std::lround(std::max(0.0, seconds)));
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

void StatusLine::draw(const std::string& line, std::optional<double> share) const {
  const std::size_t used = columns(line);
  std::string text = shortened(line, room());
  if (share && used + 3 + shortest_bar <= room()) {
    const std::size_t length = std::min(room() - used - 3, longest_bar);
    const double full = std::clamp(*share, 0.0, 1.0) * static_cast<double>(length);
    const auto marks = static_cast<std::size_t>(std::lround(full));
    text = fmt::format("[{}{}{}{}] {}", terminal_.colours ? "\033[36m" : "", std::string(marks, '#'),
                       std::string(length - marks, '.'), terminal_.colours ? "\033[0m" : "", text);
  }
  aside_raw(fmt::format("\r{}\033[K", text));
  std::fflush(stderr);
}

void StatusLine::clear() const {
  aside_raw("\r\033[K");
  std::fflush(stderr);
}

}  // namespace tunica::text
