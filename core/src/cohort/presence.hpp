// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "cohort/fitting.hpp"
#include "cohort/shares.hpp"

namespace tunica::cohort {

/// Which specimens still have to be fitted, one byte each: the question of `collect` without its answer's memory.
/// Nothing is to be done for one that cannot be read.
std::vector<char> missing_records(const Specification& cohort, const SpecimenTable& table, const Template& pattern,
                                  const plugins::Catalogue& catalogue, const std::filesystem::path& results);

/// How far a share is.
struct ShareProgress {
  Share share;
  std::size_t specimens = 0, missing = 0;
};
std::vector<ShareProgress> progress_of_shares(const std::vector<char>& missing, std::size_t shares);

}  // namespace tunica::cohort
