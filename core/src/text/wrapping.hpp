// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Text for a terminal of 80 columns. What is not plain (escaped.hpp) is shown escaped, so that text of files and
/// plugins moves no cursor and colours no screen.
namespace tunica::text {

/// Columns that UTF-8 text takes: one a code point, which is right for the letters, Greek and signs we print.
std::size_t columns(std::string_view text);

/// Fills up with spaces to `width` columns, on the right or (for numbers) on the left.
std::string pad(std::string_view text, std::size_t width);
std::string pad_left(std::string_view text, std::size_t width);

/// At most so many columns, the end of what is longer as "…".
std::string shortened(std::string_view text, std::size_t width);

/// `text` after `lead`, wrapped to `width` columns, further lines indented to where the text began. A lead that takes
/// more than half of that, a long name for example, stands on a line of its own.
std::string hanging(std::string_view lead, std::string_view text, std::size_t width = 80);

}  // namespace tunica::text
