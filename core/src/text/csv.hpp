// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tunica::text {

/// A cell as RFC 4180 wants it, on one line, that does nothing but stand there. Characters that act on a terminal or on
/// the direction of reading are escaped. A text that a spreadsheet would take for a formula (=, +, -, @ at its
/// beginning, and no number) gets an apostrophe before it, and so does one that has an apostrophe already.
std::string csv_cell(std::string_view text);

/// The text of a cell, quotes taken off, without the apostrophe that csv_cell() put before it.
std::string cell_text(std::string_view cell);

}  // namespace tunica::text
