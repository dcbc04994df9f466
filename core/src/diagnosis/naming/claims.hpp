// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "diagnosis/naming/groups.hpp"

namespace tunica::diagnosis {

/// The claimed explanation of the misfit.
struct Claim {
  std::vector<Cause> causes;  ///< of the best explanation first, then rivals
  std::size_t named = 0;      ///< how many of the causes make up the best explanation
  std::vector<std::string> ambiguity_set;
  std::vector<std::vector<std::string>> look_alikes;   ///< the ambiguity set by what looks alike; empty for groups
  std::vector<std::vector<std::string>> alternatives;  ///< to a group that is named: what rivals it, likeliest first
  /// Explanations of the set with an amplitude at its bound or beyond what is plausible, by their ids.
  std::set<std::vector<std::string>> doubted;
  std::vector<std::string> in_words;  ///< the set where ids do not say it: with places; else empty
  std::optional<Refit> best;
  std::vector<Refit> rivals;  ///< the best, and what explains the misfit as well
  std::optional<Rejected> best_rejected;
};

/// A claim, and what the verdict depends on.
struct WeighedClaim {
  Claim claim;
  std::vector<std::size_t> directions;  ///< of the causes that make up the best explanation
  std::size_t explanations = 0;         ///< in the ambiguity set, look-alikes counted once
  bool alone = true;                    ///< without a rival in the set
  /// The member of a group whose gain alone is negligible against the gain of the group; else empty. Of two real
  /// causes, each shows in the data. A member that shows only beside another may correct the other's shape for an
  /// unlisted effect.
  std::string correction;
};

/// The likeliest single mechanism and those about as likely; `ranking` has the probabilities of the singles.
WeighedClaim claim_one(const Inquiry& inquiry, const Analysis& analysis, const std::vector<Single>& singles,
                       const std::vector<RankedMechanism>& ranking);

/// The likeliest group, and beside it groups as large and single mechanisms, which are likelier before the data. Where
/// it is `clean`, it leaves only noise: beside it what is not credible weighs a twentieth of it at most, if it is.
WeighedClaim claim_several(const Inquiry& inquiry, const Analysis& analysis, const std::vector<Group>& groups,
                           const std::vector<Single>& singles, bool clean = true);

}  // namespace tunica::diagnosis
