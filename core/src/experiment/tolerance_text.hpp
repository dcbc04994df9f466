// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tunica::experiment {

/// A tolerance as it is written: "2 %" of the range, from above 0 to 50 %. Throws InputError, which begins with
/// `where`.
std::string tolerance_text(const std::string& text, std::string_view where);

}  // namespace tunica::experiment
