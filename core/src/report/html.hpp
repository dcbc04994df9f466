// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

/// Names, units and messages come from untrusted files: they must never act as code in the page.
namespace tunica::report {

/// Text for HTML, inside elements and inside quoted attributes. What is no UTF-8 becomes U+FFFD; control characters
/// and marks of direction become visible.
std::string escaped(std::string_view text);

/// JSON for a <script type="application/json"> element: `<`, `>` and `&` as \u escapes, so that no tag or comment can
/// begin or end in it, and U+2028 and U+2029 too, which old scripts take for line ends.
std::string script_json(const nlohmann::ordered_json& value);

/// The Content-Security-Policy source of an inline script or style: 'sha256-…' of its bytes (CSP level 2, 4.2.5).
std::string policy_source(std::string_view inline_text);

/// A relative address of a file beside the report, with every byte but letters, digits and -_./~ as %XX.
std::string address(std::string_view path);

}  // namespace tunica::report
