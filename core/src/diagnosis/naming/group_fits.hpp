// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "diagnosis/naming/groups.hpp"

namespace tunica::diagnosis {

/// Groups of mechanisms at finite amplitude, beside all parameters.
class GroupFits {
 public:
  /// What a group is weighed against: the base fit, and the single mechanisms that have been fitted already.
  GroupFits(const Inquiry& inquiry, const Analysis& analysis, std::span<const Single> singles)
      : inquiry_(inquiry), analysis_(analysis), singles_(singles) {}

  /// Fitted side by side; those of which every member is needed, likeliest first. The
  /// progress goes from one share of the whole to the other.
  [[nodiscard]] std::vector<Group> refitted(std::vector<Group> groups, double from, double to) const;

 private:
  [[nodiscard]] double squares_with(const std::vector<Addition>& additions, std::span<const double> amplitudes,
                                    bool again, double enough) const;
  void weigh_members(std::vector<Group>& groups, const std::function<void()>& done) const;
  [[nodiscard]] std::vector<double> losses_of(const Group& group, bool again) const;

  const Inquiry& inquiry_;
  const Analysis& analysis_;
  std::span<const Single> singles_;
};

/// The group with one member taken out, not fitted.
Group without_member(const Group& group, std::size_t out);

void sort_by_weight(std::vector<Group>& groups);

}  // namespace tunica::diagnosis
