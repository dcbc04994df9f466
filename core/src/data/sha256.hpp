// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tunica::data {

/// SHA-256 (FIPS 180-4) of the bytes, 64 lower-case hexadecimal digits; for the provenance of results.
std::string sha256(std::string_view bytes);

}  // namespace tunica::data
