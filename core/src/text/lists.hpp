// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Lists and counts as a sentence has them.
namespace tunica::text {

/// "a, b and c".
std::string joined(std::span<const std::string> items);

/// "1 search", "20 searches".
std::string counted(std::size_t count, std::string_view one, std::string_view many);

/// `one` for a count of 1, else `many`: "was", "were".
std::string_view agreeing(std::size_t count, std::string_view one, std::string_view many);

/// With a capital first letter, where that is a Latin one. A name stays as it is: a first word that is one of `names`,
/// or that holds an underscore, a digit or a point.
std::string capitalised(std::string text, std::span<const std::string> names = {});

}  // namespace tunica::text
