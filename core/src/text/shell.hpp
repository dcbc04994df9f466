// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tunica::text {

/// A word as a POSIX shell reads it back: 'it'\''s'. Plain words stay as they are.
std::string quoted(const std::string& word);
/// Several words, a blank between them.
std::string quoted(const std::vector<std::string>& words);

}  // namespace tunica::text
