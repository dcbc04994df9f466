// SPDX-License-Identifier: Apache-2.0
#include "budget/steps.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <tbb/parallel_for.h>

#include "diagnosis/hypotheses/places.hpp"

namespace tunica::budget {
namespace {

constexpr std::size_t most_steps = 4;
constexpr std::size_t quick_leads = 6, full_leads = 12;  ///< that are fitted at each step
constexpr std::size_t laws_at_a_step = 2;
constexpr std::size_t in_exchange = 3;   ///< leads that each member makes room for
constexpr double worth_a_step = 0.01;    ///< of the misfit
constexpr double about_as_much = 0.15;   ///< of the misfit
constexpr double worth_an_exchange = 1;  ///< of ln p

struct Weighed {
  Mixture mixture;
  double log_weight = 0;  ///< ln p with the prior of the members
};

/// Σ over sets S without k of |S|! (n − |S| − 1)!/n! · (v(S ∪ k) − v(S))
double shapley(const std::vector<double>& shares, std::size_t count, std::size_t k) {
  double sum = 0;
  for (std::size_t set = 0; set < shares.size(); ++set) {
    const std::size_t bit = std::size_t{1} << k;
    if (set & bit) continue;
    const auto size = static_cast<double>(__builtin_popcountll(set)), n = static_cast<double>(count);
    const double weight = std::tgamma(size + 1) * std::tgamma(n - size) / std::tgamma(n + 1);
    sum += weight * (shares[set | bit] - shares[set]);
  }
  return sum;
}

class StepSearch {
 public:
  StepSearch(const Field& field, double tolerance)
      : field_(field), tolerance_(tolerance), misfit_(std::max(field.size.squares(field.mixer.base().fit), 1e-300)) {}

  Steps run(const Entrants& entrants) {
    Weighed current{field_.mixer.base(), 0};
    current.log_weight = log_evidence(field_, current.mixture);
    std::vector<Mixture> path;
    const Entrant* first = nullptr;
    // What may lead comes first: it takes about as much as any cause that can be believed.
    double most = 0;
    for (const Entrant& one : entrants.all)
      if (one.mixture && one.belief != Belief::beyond) most = std::max(most, one.share);
    for (const Entrant& one : entrants.all)
      if (one.mixture && one.share >= most - about_as_much && (!first || one.log_evidence > first->log_evidence))
        first = &one;
    while (path.size() < most_steps && field_.size.of(current.mixture.fit).rms > (path.empty() ? 0 : tolerance_)) {
      std::optional<Weighed> next;
      if (path.empty() && first)
        next = Weighed{*first->mixture, first->log_evidence};
      else if (!path.empty())
        next = best(current.mixture, leads());
      if (!next || !(next->log_weight > current.log_weight) ||
          share(next->mixture) < share(current.mixture) + worth_a_step)
        break;
      current = std::move(*next);
      if (current.mixture.members.size() > 1) current = exchanged(std::move(current));
      path.push_back(current.mixture);
    }
    Steps steps;
    if (path.empty()) return steps;
    steps.all = steps_of(field_, current.mixture);
    steps.fitted = std::move(current.mixture);
    return steps;
  }

 private:
  [[nodiscard]] std::size_t leads() const { return field_.inquiry.request.quick ? quick_leads : full_leads; }
  [[nodiscard]] double share(const Mixture& mixture) const { return 1 - field_.size.squares(mixture.fit) / misfit_; }

  [[nodiscard]] double prior_of(const Mixture& mixture) const {
    double sum = 0;
    for (const Member& member : mixture.members) {
      double own = -INFINITY;
      for (const Lead& lead : field_.leads)
        if (lead.member.key() == member.key()) own = std::max(own, lead.log_prior);
      sum += own;
    }
    return sum;
  }

  /// The mixture with the lead that the data say most for.
  [[nodiscard]] std::optional<Weighed> best(const Mixture& from, std::size_t count) const {
    const auto chosen = promising(field_, from, count, laws_at_a_step);
    std::vector<std::optional<Weighed>> tried(chosen.size());
    tbb::parallel_for(std::size_t{0}, chosen.size(), [&](std::size_t k) {
      if (auto mixture = field_.mixer.grown(from, *chosen[k])) {
        const double weight = log_evidence(field_, *mixture) + prior_of(*mixture);
        tried[k] = Weighed{std::move(*mixture), weight};
      }
    });
    std::optional<Weighed> found;
    for (auto& one : tried)
      if (one && (!found || one->log_weight > found->log_weight)) found = std::move(one);
    return found;
  }

  /// Each member in turn makes room for another lead.
  [[nodiscard]] Weighed exchanged(Weighed current) const {
    for (std::size_t out = 0; out + 1 < current.mixture.members.size(); ++out) {
      std::vector<bool> kept(current.mixture.members.size(), true);
      kept[out] = false;
      const auto rest = field_.mixer.reduced(current.mixture, kept);
      if (!rest) continue;
      auto other = best(*rest, in_exchange);
      if (other && other->log_weight > current.log_weight + worth_an_exchange) current = std::move(*other);
    }
    return current;
  }

  const Field& field_;
  double tolerance_, misfit_;
};

}  // namespace

std::vector<Step> steps_of(const Field& field, const Mixture& whole) {
  const double misfit = std::max(field.size.squares(field.mixer.base().fit), 1e-300);
  const std::size_t count = whole.members.size(), all = (std::size_t{1} << count) - 1;
  std::vector<std::optional<Mixture>> fits(all + 1);
  std::vector<double> shares(all + 1, 0);
  tbb::parallel_for(std::size_t{1}, all + 1, [&](std::size_t set) {
    std::vector<bool> kept(count);
    for (std::size_t k = 0; k < count; ++k) kept[k] = (set >> k & 1) != 0;
    fits[set] = set == all ? std::optional<Mixture>(whole) : field.mixer.reduced(whole, kept);
    if (fits[set]) shares[set] = std::max(1 - field.size.squares(fits[set]->fit) / misfit, 0.0);
  });
  // A larger set takes no less than what is in it.
  for (std::size_t set = 1; set <= all; ++set)
    for (std::size_t k = 0; k < count; ++k)
      if (set >> k & 1) shares[set] = std::max(shares[set], shares[set ^ (std::size_t{1} << k)]);

  std::vector<Step> steps;
  std::size_t taken = 0;
  while (taken != all) {
    std::size_t next = count;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t bit = std::size_t{1} << k;
      if ((taken & bit) == 0 && (next == count || shares[taken | bit] > shares[taken | std::size_t{1} << next]))
        next = k;
    }
    taken |= std::size_t{1} << next;
    Step step;
    const Member& member = whole.members[next];
    step.id = member.words();
    step.term = !member.mechanism;
    if (member.mechanism) {
      step.place = member.mechanism->place;
      step.group = diagnosis::group_of(field.inquiry.mechanism(member.mechanism->id));
    }
    step.belief = belief_of(field, whole, next);
    step.share = shares[taken];
    step.shapley = shapley(shares, count, next);
    step.rest = fits[taken] ? field.size.of(fits[taken]->fit) : Size{};
    steps.push_back(std::move(step));
  }
  return steps;
}

Steps steps_of(const Field& field, const Entrants& entrants, double tolerance) {
  return StepSearch(field, tolerance).run(entrants);
}

}  // namespace tunica::budget
