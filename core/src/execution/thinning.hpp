// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "execution/checkpoint.hpp"
#include "execution/plan.hpp"
#include "execution/recovery.hpp"

/// evaluations.csv without the rows that nothing needs once all searches have ended.
namespace tunica::execution {

/// Leaves the rows of each realisation that were better than every row before it, the best point among them. All
/// searches have to be finished: their results are in checkpoint.json, which notes first that the journal is thinned.
/// A process that ends in between leaves all rows, and nothing is lost. Throws WriteFailure.
void thin_evaluations(const Plan& plan, const std::filesystem::path& directory);

/// Throws InputError where a search of a thinned journal would have to be made again: its rows are gone.
void refuse_unfinished(const std::filesystem::path& directory, const Checkpoint& checkpoint, std::size_t tasks);

/// What a thinned journal holds: as many evaluations of each search as it has made, none of which is replayed.
Recovered thinned_journal(const Checkpoint& checkpoint, std::size_t tasks);

}  // namespace tunica::execution
