// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/hypotheses/record_errors.hpp"

#include <algorithm>
#include <array>

namespace tunica::diagnosis {

bool errs_in_the_record(std::string_view mechanism) {
  constexpr std::array<std::string_view, 7> known{
      "displacement_offset", "zeroed_at_preload",       "machine_compliance", "sheet_prestretch",
      "sheet_force_offset",  "sheet_force_scale_error", "channel_lag"};
  return std::find(known.begin(), known.end(), mechanism) != known.end();
}

}  // namespace tunica::diagnosis
