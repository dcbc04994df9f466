// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tunica::data {

/// The text of a file without its byte order mark; `decoded` holds it where the file is UTF-16. Throws InputError on
/// workbooks and other files that are no text, with what to do.
std::string_view text_of(const std::filesystem::path& file, std::string_view bytes, std::string& decoded);

}  // namespace tunica::data
