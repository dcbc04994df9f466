// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Comments and numbers of cards.
namespace tunica::cards {

/// Greek letters and signs by their names, control characters as '?', what is left outside ASCII as '?'.
std::string ascii(std::string_view text);

/// A paragraph as comment lines, each ended, of at most 78 columns: `lead` begins every line, further ones are
/// indented.
std::string comment(std::string_view lead, std::string_view paragraph);

/// Twelve digits: at most 18 columns, of the 20 that CalculiX reads.
std::string number(double value);

}  // namespace tunica::cards
