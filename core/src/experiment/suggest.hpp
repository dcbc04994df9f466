// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "data/nearest.hpp"

namespace tunica::experiment {

using data::excerpt;
using data::nearest;
using data::suggestion;

/// "unknown parameter 'kapa' of model 'gho' (/models/gho/parameters/kapa). Did you mean 'kappa'? Known: mu, kappa."
/// For names that can only be checked after reading, when no line is at hand any more; `noun` is "parameter of model
/// 'gho'" split as ("parameter", "model 'gho'").
inline std::string unknown_name_message(std::string_view noun, std::string_view found, std::string_view owner,
                                        std::string_view pointer, const std::vector<std::string>& known) {
  return fmt::format("unknown {} '{}' of {} ({}). {}", noun, excerpt(found), owner, pointer, suggestion(found, known));
}

}  // namespace tunica::experiment
