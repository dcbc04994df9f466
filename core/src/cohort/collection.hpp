// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cohort/fitting.hpp"

namespace tunica::cohort {

/// What the shards have left: a record for each specimen of the table, whoever made it.
struct Collection {
  std::vector<Record> records;       ///< one a specimen, in the order of the table
  std::vector<std::size_t> missing;  ///< specimens without a record, or evidence, of their present inputs

  [[nodiscard]] std::size_t count(Outcome outcome) const;
};

/// Reads the records of a results folder. One whose inputs have changed since is missing. A specimen that cannot be
/// read now is `unreadable`, whatever its record says.
Collection collect(const Specification& cohort, const SpecimenTable& table, const Template& pattern,
                   const plugins::Catalogue& catalogue, const std::filesystem::path& results);

}  // namespace tunica::cohort
