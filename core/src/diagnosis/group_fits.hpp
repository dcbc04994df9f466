// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "diagnosis/groups.hpp"

namespace tunica::diagnosis {

/// Groups of mechanisms at finite amplitude, beside all parameters.
class GroupFits {
 public:
  /// What a group is weighed against: the base fit, and the single mechanisms that have been fitted already.
  GroupFits(const Diagnosis& diagnosis, const Detection& detection, std::span<const Single> singles,
            const plugins::Catalogue& catalogue)
      : d_(diagnosis), detection_(detection), singles_(singles), catalogue_(catalogue) {}

  /// Fitted side by side; those of which every member is needed, likeliest first.
  [[nodiscard]] std::vector<Group> refitted(std::vector<Group> groups) const;

 private:
  [[nodiscard]] double squares_with(const std::vector<Addition>& additions, std::span<const double> amplitudes,
                                    bool again) const;
  [[nodiscard]] bool all_needed(Group& group, bool again) const;

  const Diagnosis& d_;
  const Detection& detection_;
  std::span<const Single> singles_;
  const plugins::Catalogue& catalogue_;
};

/// The group with one member taken out, not fitted.
Group without(const Group& group, std::size_t out);

void sort_by_weight(std::vector<Group>& groups);

}  // namespace tunica::diagnosis
