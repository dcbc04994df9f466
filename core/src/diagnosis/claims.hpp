// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnosis/groups.hpp"

namespace tunica::diagnosis {

/// What is said to explain the misfit, as far as the verdict depends on it.
struct Claim {
  std::size_t explanations = 0;  ///< in the ambiguity set, look-alikes counted once
  bool alone = true;             ///< without a rival in the set
  /// The member of a group that by itself takes next to nothing of what the group takes. Two causes each show in the
  /// data; what shows only beside another may make up for its shape, that of an effect which no mechanism lists. Else
  /// empty.
  std::string correction;
};

/// Fills causes, ambiguity set, rivals and extension with the likeliest single mechanism and those about as likely.
Claim claim_one(Diagnosis& diagnosis, const Detection& detection, const std::vector<Single>& singles,
                const plugins::Catalogue& catalogue);

/// The same with the likeliest group, and beside it groups as large and single mechanisms, which are likelier before
/// the data.
Claim claim_several(Diagnosis& diagnosis, const Detection& detection, const std::vector<Group>& groups,
                    const std::vector<Single>& singles, const plugins::Catalogue& catalogue);

}  // namespace tunica::diagnosis
