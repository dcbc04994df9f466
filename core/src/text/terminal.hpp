// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace tunica::text {

/// What is at the other end of stdout or stderr.
struct Terminal {
  bool redraws = false;  ///< a terminal that can take a line back: not a file, a pipe or TERM=dumb
  bool colours = false;  ///< the same, and NO_COLOR (no-color.org) is empty or not set
  std::size_t columns = 80;

  static Terminal of(int descriptor);
};

/// "0:07", "12:30", "3:05:00"
std::string clock_text(double seconds);

/// One line on stderr that is redrawn, with a bar where there is room for one.
class StatusLine {
 public:
  explicit StatusLine(Terminal terminal) : terminal_(terminal) {}
  /// `share` from 0 to 1 is how far it is; without one there is no bar.
  void draw(const std::string& line, std::optional<double> share) const;
  /// Takes it off the screen again.
  void clear() const;
  [[nodiscard]] std::size_t room() const { return terminal_.columns - 1; }  ///< columns for the line

 private:
  Terminal terminal_;
};

}  // namespace tunica::text
