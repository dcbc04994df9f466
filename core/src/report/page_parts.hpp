// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// What every report carries, embedded when the program is built.
namespace tunica::report {

extern const std::string_view page_library;  ///< Vega
extern const std::string_view page_script;   ///< draws the charts
extern const std::string_view page_style;    ///< CSS

}  // namespace tunica::report
