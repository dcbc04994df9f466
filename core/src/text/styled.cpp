// SPDX-License-Identifier: Apache-2.0
#include "text/styled.hpp"

#include "text/terminal.hpp"
#include "text/wrapping.hpp"

namespace tunica::text {

namespace {

constexpr std::string_view yellow = "\033[33m", bold = "\033[1m", normal = "\033[0m";

}  // namespace

StyledText& StyledText::operator+=(std::string_view plain) {
  text_ += plain;
  return *this;
}

StyledText& StyledText::operator+=(const StyledText& more) {
  for (const Mark& mark : more.marks_)
    marks_.push_back({text_.size() + mark.begin, text_.size() + mark.end, mark.emphasis});
  text_ += more.text_;
  return *this;
}

StyledText& StyledText::add(std::string_view part, Emphasis emphasis) {
  marks_.push_back({text_.size(), text_.size() + part.size(), emphasis});
  text_ += part;
  return *this;
}

std::string StyledText::coloured() const {
  std::string result;
  std::size_t at = 0;
  for (const Mark& mark : marks_) {
    result.append(text_, at, mark.begin - at).append(mark.emphasis == Emphasis::heading ? bold : yellow);
    result.append(text_, mark.begin, mark.end - mark.begin).append(normal);
    at = mark.end;
  }
  return result.append(text_, at);
}

std::string StyledText::shown_on(int descriptor) const { return Terminal::of(descriptor).colours ? coloured() : text_; }

StyledText caution_line(std::string_view sentence) {
  constexpr std::string_view lead = "  ! ";
  StyledText line("  ");
  line.add("!", Emphasis::caution);
  line += hanging(lead, sentence).substr(3);
  return line += "\n";
}

}  // namespace tunica::text
