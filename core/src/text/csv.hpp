// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tunica::text {

/// A cell as RFC 4180 wants it, on one line.
std::string csv_cell(std::string_view text);

}  // namespace tunica::text
