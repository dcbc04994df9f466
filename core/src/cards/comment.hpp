// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

/// Comments and numbers of cards.
namespace tunica::cards {

/// Greek letters and signs by their names, control characters as '?', what is left outside ASCII as '?'.
std::string ascii(std::string_view text);

/// A paragraph as comment lines, each ended, of at most 78 columns: `lead` begins every line, further ones are
/// indented.
std::string comment(std::string_view lead, std::string_view paragraph);

/// Several of them.
std::string comments(std::string_view lead, std::span<const std::string> paragraphs);

/// The same as one comment of XML, in which "--" may not stand.
std::string xml_comment(std::span<const std::string> paragraphs);

/// Up to fifteen digits, at most 19 columns: CalculiX reads 20.
std::string number(double value);

}  // namespace tunica::cards
