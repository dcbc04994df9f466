// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/group_fits.hpp"

#include <algorithm>
#include <utility>

#include <tbb/parallel_for.h>

#include "diagnosis/naming/remainder.hpp"

namespace tunica::diagnosis {
namespace {

constexpr std::size_t groups_searched_again = 6;  ///< of the likeliest, without each of their members
constexpr std::size_t enough_groups = 3;          ///< that triples are begun from
constexpr double out_of_the_question = 15;        ///< of ln w below the likeliest

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
  weigh_members(groups, done);
  return groups;
}

/// Removes the groups with an unneeded member, the likeliest first. After some groups have passed, groups that are far
/// less likely are removed too.
void GroupFits::weigh_members(std::vector<Group>& groups, const std::function<void()>& done) const {
  std::vector<Group> kept;
  for (std::size_t first = 0; first < groups.size(); first += groups_searched_again) {
    const std::size_t last = std::min(first + groups_searched_again, groups.size());
    tbb::parallel_for(first, last, [&](std::size_t g) {
      if (kept.size() < enough_groups || groups[g].log_weight > kept.front().log_weight - out_of_the_question)
        groups[g].losses = losses_of(groups[g], first == 0);
      done();
    });
    for (std::size_t g = first; g < last; ++g)
      if (!groups[g].losses.empty()) kept.push_back(std::move(groups[g]));
  }
  groups = std::move(kept);
}

/// |r|² of a refit with the additions, which for a single one may have been made already. Below `enough` it is not
/// looked for again.
double GroupFits::squares_with(const std::vector<Addition>& additions, std::span<const double> amplitudes, bool again,
                               double enough) const {
  const Fit& base = analysis_.evidence.fit;
  again = again && at_a_bound(base);
  for (const Single& single : singles_)
    if (single.best && !again && additions.size() == 1 && single.best->additions.front().id == additions.front().id &&
        single.best->additions.front().place == additions.front().place)
      return single.best->fit.chi2;
  auto refit = fit_with(inquiry_, analysis_, additions, amplitudes);
  if (refit && again) refit = searched_again(inquiry_, analysis_, std::move(*refit), enough);
  return refit ? std::min(refit->fit.chi2, base.chi2) : base.chi2;
}

/// What |r|² rises by when each member is taken out and the rest is fitted again; empty where a member is not needed.
std::vector<double> GroupFits::losses_of(const Group& group, bool again) const {
  std::vector<double> losses;
  for (std::size_t out = 0; out < group.additions.size(); ++out) {
    const Group rest = without_member(group, out);
    const std::size_t candidate = analysis_.hypotheses.directions[group.directions[out]].candidate;
    const double squares = group.refit->fit.chi2;
    const double needed = analysis_.alarm.detector->threshold(candidate, second_alpha);
    losses.push_back(squares_with(rest.additions, rest.amplitudes, again, squares + needed) - squares);
    if (losses.back() < needed) return {};
  }
  return losses;
}

}  // namespace tunica::diagnosis
