// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// Text of others (files, names, plugins, arguments) as a terminal, a message or a JSON document may carry it.
namespace tunica::text {

/// Whether the text is well-formed UTF-8 as RFC 3629 has it.
bool is_utf8(std::string_view text);

/// Whether the text is UTF-8 that does nothing but stand where it is: no control character, and no mark that turns the
/// direction of reading or breaks the line.
bool is_plain(std::string_view text);

/// What is not plain becomes visible: "\x1b", "\u202e", "\xff" for a byte that is not UTF-8. Lines stay lines where
/// `keep` holds "\n". Text that is plain stays as it is, so that to escape twice is to escape once.
std::string escaped(std::string_view text, std::string_view keep = {});

/// Escaped, and at most about `limit` bytes: of what is longer the beginning, with "…" behind it. Never cut within a
/// character. The work is that of the part that is shown.
std::string excerpt(std::string_view text, std::size_t limit = 60);

/// A message as it is shown: escaped but for its lines, a word of more than 600 bytes and a text of more than 20 000
/// cut short.
std::string message(std::string_view text);

/// What the JSON library says, `what` of its exception, without its codes: "parse error at line 1, column 2: …".
std::string json_problem(std::string_view what);

/// JSON text with \u escapes for what the library writes raw: DEL, C1 controls, marks of direction. The document stays
/// the same.
std::string plain_json(std::string json);

}  // namespace tunica::text
