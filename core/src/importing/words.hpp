// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "data/words.hpp"

namespace tunica::importing {

using data::as_utf8;
using data::folded;
using data::has_any;
using data::has_word;
using data::words_of;

/// "PA Belly.1" → "PA_Belly_1": names in an experiment file have no dots, slashes or blanks.
std::string as_name(std::string text);

/// "a, b, c, …": at most eight.
std::string listed(const std::vector<std::string>& values);

}  // namespace tunica::importing
