// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "execution/plan.hpp"
#include "execution/share.hpp"

/// The realisations of one experiment, split into parts. Any process may run any part, in any order and repeatedly.
namespace tunica::execution {

/// The folder of a part: shards/<k>of<N>, like that of a run.
std::filesystem::path shard_folder(const std::filesystem::path& directory, const Share& share);

/// Combines the results of the parts. A resumed run in `directory` then finds every realisation finished and searches
/// nothing. It may be repeated. Throws InputError if a realisation is missing, a part is still running, or a fact has
/// changed since the part began. `noticed` receives the damage to a part and its consequence.
void gather_shards(const Plan& plan, const std::filesystem::path& directory,
                   const std::function<void(const std::string& sentence)>& noticed = {});

}  // namespace tunica::execution
