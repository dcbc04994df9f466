// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "execution/checkpoint.hpp"
#include "execution/plan.hpp"
#include "execution/recovery.hpp"

/// Removes the rows of evaluations.csv that are not needed after all searches have ended.
namespace tunica::execution {

/// Keeps the rows of each realisation that were better than all earlier ones, including the best point. All searches
/// must be finished. Their results are in checkpoint.json, which first records that the journal is thinned. A process
/// that ends in between leaves all rows, and nothing is lost. Throws WriteFailure.
void thin_evaluations(const Plan& plan, const std::filesystem::path& directory);

/// Throws InputError if a search of a thinned journal would have to run again, because its rows are gone.
void refuse_unfinished(const std::filesystem::path& directory, const Checkpoint& checkpoint, std::size_t tasks);

/// The contents of a thinned journal: the number of evaluations of each search, none of which is replayed.
Recovered thinned_journal(const Checkpoint& checkpoint, std::size_t tasks);

}  // namespace tunica::execution
