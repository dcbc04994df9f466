// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "execution/plan.hpp"
#include "execution/share.hpp"

/// The realisations of one experiment in parts that any process makes, in any order and as often as it likes.
namespace tunica::execution {

/// Where a part works: shards/<k>of<N>, a folder like that of a run.
std::filesystem::path shard_folder(const std::filesystem::path& directory, const Share& share);

/// Puts together what the parts have left, so that a resumed run in `directory` finds every realisation finished and
/// searches nothing. May be repeated. Throws InputError where a realisation is missing, a part is still at work, or
/// something has changed since it began. `noticed` is told what was damaged in a part, and what becomes of it.
void gather_shards(const Plan& plan, const std::filesystem::path& directory,
                   const std::function<void(const std::string& sentence)>& noticed = {});

}  // namespace tunica::execution
