// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/group_fits.hpp"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "diagnosis/refits.hpp"

namespace tunica::diagnosis {
namespace {

constexpr std::size_t groups_searched_again = 6;  ///< of the likeliest, without each of their members

}  // namespace

Group without(const Group& group, std::size_t out) {
  Group rest;
  for (std::size_t k = 0; k < group.additions.size(); ++k) {
    if (k == out) continue;
    rest.directions.push_back(group.directions[k]), rest.additions.push_back(group.additions[k]);
    rest.amplitudes.push_back(group.amplitudes[k]);
  }
  return rest;
}

void sort_by_weight(std::vector<Group>& groups) {
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.log_weight > b.log_weight; });
}

std::vector<Group> GroupFits::refitted(std::vector<Group> groups) const {
  tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
    Group& group = groups[g];
    group.refitted = fit_with(d_, group.additions, group.amplitudes, catalogue_, group.begun_from.get());
    if (!group.refitted) return;
    search_again(d_, *group.refitted);
    group.log_weight = (d_.fit.chi2 - group.refitted->fit.chi2) / 2;
    for (const std::size_t k : group.directions) group.log_weight += log_prior(d_, k);
  });
  std::erase_if(groups, [](const Group& group) { return !group.refitted; });
  sort_by_weight(groups);
  std::vector<char> needed(groups.size(), 0);
  tbb::parallel_for(std::size_t{0}, groups.size(),
                    [&](std::size_t g) { needed[g] = all_needed(groups[g], g < groups_searched_again); });
  std::vector<Group> kept;
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (needed[g]) kept.push_back(std::move(groups[g]));
  return kept;
}

/// |r|² of a refit with the additions, which for a single one may have been made already.
double GroupFits::squares_with(const std::vector<Addition>& additions, std::span<const double> amplitudes,
                               bool again) const {
  again = again && at_a_bound(d_.fit);
  for (const Single& single : singles_)
    if (single.best && !again && additions.size() == 1 && single.best->additions.front().id == additions.front().id &&
        single.best->additions.front().target == additions.front().target)
      return single.best->fit.chi2;
  auto refitted = fit_with(d_, additions, amplitudes, catalogue_);
  if (refitted && again) search_again(d_, *refitted);
  return refitted ? std::min(refitted->fit.chi2, d_.fit.chi2) : d_.fit.chi2;
}

/// Each member loses significantly when it is taken out: the rest is fitted again without it.
bool GroupFits::all_needed(Group& group, bool again) const {
  for (std::size_t out = 0; out < group.additions.size(); ++out) {
    const Group rest = without(group, out);
    const std::size_t candidate = d_.directions[group.directions[out]].candidate;
    group.losses.push_back(squares_with(rest.additions, rest.amplitudes, again) - group.refitted->fit.chi2);
    if (group.losses.back() < detection_.threshold(candidate, second_alpha)) return false;
  }
  return true;
}

}  // namespace tunica::diagnosis
