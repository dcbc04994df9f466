// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace blind {

/// SHA-256 of a sealed truth, in hexadecimal: written beside the case, compared when the truth is opened.
std::string sha256(const std::string& bytes);

}  // namespace blind
