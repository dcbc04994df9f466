// SPDX-License-Identifier: Apache-2.0
#include "experiment/tolerance_text.hpp"

#include <fmt/format.h>

#include "data/units.hpp"
#include "tunica/error.hpp"

namespace tunica::experiment {

std::string tolerance_text(const std::string& text, std::string_view where) {
  double share = 0;
  try {
    if (text.ends_with('%')) share = data::parse_quantity(text, "1");
  } catch (const InputError&) {  // said below, with the place
  }
  if (share > 0 && share <= 0.5) return text;
  throw InputError(fmt::format(
      "{}: '{}' is no tolerance. Give a share of the range above 0 and up to 50 %, as \"2 %\".", where, text));
}

}  // namespace tunica::experiment
