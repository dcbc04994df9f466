// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace tunica::cohort {

/// The folder that a start of a cohort writes to: `requested`, which holds an earlier start or nothing, else a new
/// results/<name>-<n>. Shards may begin at once: none of them takes the folder for another's because a neighbour is a
/// moment ahead. Throws InputError where the folder holds something else, or cannot be made.
std::filesystem::path results_folder(const std::filesystem::path& requested, const std::string& name);

}  // namespace tunica::cohort
