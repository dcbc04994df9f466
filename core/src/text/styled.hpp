// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::text {

enum class Emphasis { heading, caution };

/// A text for a person, parts of which stand out on a terminal that has colours. The writer marks these parts.
class StyledText {
 public:
  StyledText() = default;
  explicit StyledText(std::string plain) : text_(std::move(plain)) {}

  StyledText& operator+=(std::string_view plain);
  StyledText& operator+=(const StyledText& more);
  StyledText& add(std::string_view part, Emphasis emphasis);

  /// Without control characters, so that it can go to a file.
  [[nodiscard]] const std::string& plain() const { return text_; }
  /// With the colours of a terminal.
  [[nodiscard]] std::string coloured() const;
  /// For the terminal or file at the other end of `descriptor`.
  [[nodiscard]] std::string shown_on(int descriptor) const;

 private:
  struct Mark {
    std::size_t begin, end;
    Emphasis emphasis;
  };
  std::string text_;
  std::vector<Mark> marks_;  ///< in order, none within another
};

/// A line that warns: "  ! " with its mark, and the sentence wrapped behind it.
StyledText caution_line(std::string_view sentence);

}  // namespace tunica::text
