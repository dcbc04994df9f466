// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/group_fits.hpp"

#include <algorithm>
#include <utility>

#include <tbb/parallel_for.h>

#include "diagnosis/naming/remainder.hpp"

namespace tunica::diagnosis {
namespace {

constexpr std::size_t groups_searched_again = 6;  ///< of the likeliest, without each of their members

}  // namespace

Group without_member(const Group& group, std::size_t out) {
  Group rest;
  for (std::size_t k = 0; k < group.additions.size(); ++k) {
    if (k == out) continue;
    rest.directions.push_back(group.directions[k]);
    rest.additions.push_back(group.additions[k]);
    rest.amplitudes.push_back(group.amplitudes[k]);
  }
  return rest;
}

void sort_by_weight(std::vector<Group>& groups) {
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.log_weight > b.log_weight; });
}

std::vector<Group> GroupFits::refitted(std::vector<Group> groups, double from, double to) const {
  const std::vector<Direction>& directions = analysis_.hypotheses.directions;
  const auto done = inquiry_.steps("fitting mechanisms together", from, to, 2 * groups.size());
  const auto fit = [&](Group& group) {
    group.refit = fit_with(inquiry_, analysis_, group.additions, group.amplitudes, group.begun_from.get());
    if (!group.refit) return;
    group.refit = searched_again(inquiry_, analysis_, std::move(*group.refit));
    group.log_weight = (analysis_.evidence.fit.chi2 - group.refit->fit.chi2) / 2;
    for (const std::size_t k : group.directions) group.log_weight += log_prior(directions[k]);
  };
  tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
    fit(groups[g]);
    done();
  });
  std::erase_if(groups, [](const Group& group) { return !group.refit; });
  sort_by_weight(groups);
  tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
    groups[g].losses = losses_of(groups[g], g < groups_searched_again);
    done();
  });
  std::erase_if(groups, [](const Group& group) { return group.losses.empty(); });
  return groups;
}

/// |r|² of a refit with the additions, which for a single one may have been made already.
double GroupFits::squares_with(const std::vector<Addition>& additions, std::span<const double> amplitudes,
                               bool again) const {
  const Fit& base = analysis_.evidence.fit;
  again = again && at_a_bound(base);
  for (const Single& single : singles_)
    if (single.best && !again && additions.size() == 1 && single.best->additions.front().id == additions.front().id &&
        single.best->additions.front().place == additions.front().place)
      return single.best->fit.chi2;
  auto refit = fit_with(inquiry_, analysis_, additions, amplitudes);
  if (refit && again) refit = searched_again(inquiry_, analysis_, std::move(*refit));
  return refit ? std::min(refit->fit.chi2, base.chi2) : base.chi2;
}

/// What |r|² rises by when each member is taken out and the rest is fitted again; empty where a member is not needed.
std::vector<double> GroupFits::losses_of(const Group& group, bool again) const {
  std::vector<double> losses;
  for (std::size_t out = 0; out < group.additions.size(); ++out) {
    const Group rest = without_member(group, out);
    const std::size_t candidate = analysis_.hypotheses.directions[group.directions[out]].candidate;
    losses.push_back(squares_with(rest.additions, rest.amplitudes, again) - group.refit->fit.chi2);
    if (losses.back() < analysis_.alarm.detector->threshold(candidate, second_alpha)) return {};
  }
  return losses;
}

}  // namespace tunica::diagnosis
