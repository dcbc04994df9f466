// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/credibility.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/naming/causes.hpp"
#include "diagnosis/naming/credible.hpp"
#include "diagnosis/naming/group_fits.hpp"
#include "diagnosis/naming/remainder.hpp"

namespace tunica::diagnosis {
namespace {

struct Explained {
  double* log_weight;
  const Refit* refit;
  bool credible;
};

void weigh(const Analysis& analysis, std::vector<Explained> all) {
  const auto doubtful = std::count_if(all.begin(), all.end(), [](const Explained& one) { return !one.credible; });
  if (doubtful == 0) return;
  for (const Explained& one : all)
    if (!one.credible) *one.log_weight -= std::log(odds_against);
  std::stable_sort(all.begin(), all.end(),
                   [](const Explained& a, const Explained& b) { return *a.log_weight > *b.log_weight; });
  std::vector<double> logs;
  for (const Explained& one : all) logs.push_back(*one.log_weight);
  const double whole = log_sum(logs);
  double mass = 0;
  bool doubt = false;
  const Explained* best = nullptr;  // credible, in the set
  for (const Explained& one : all) {
    if (mass >= set_mass) break;
    mass += std::exp(*one.log_weight - whole);
    doubt = doubt || !one.credible;
    if (one.credible && best == nullptr) best = &one;
  }
  if (!doubt || best == nullptr || !is_clean(p_of_remainder(analysis, *best->refit))) return;
  const double most = *best->log_weight - std::log(odds_against * static_cast<double>(doubtful));
  for (const Explained& one : all)
    if (!one.credible) *one.log_weight = std::min(*one.log_weight, most);
}

}  // namespace

bool is_credible(const Inquiry& inquiry, const Analysis& analysis, const Refit& refit,
                 const std::vector<std::size_t>& directions) {
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const Direction& direction = analysis.hypotheses.directions[directions[k]];
    const Amplitude amplitude = cause_of(inquiry, analysis, refit, k, direction).amplitude;
    if (amplitude.at_bound || !amplitude.plausible) return false;
  }
  return true;
}

void weigh_credibility(const Inquiry& inquiry, const Analysis& analysis, std::vector<Single>& singles) {
  std::vector<Explained> all;
  for (Single& one : singles)
    if (one.best)
      all.push_back({&one.log_weight, &*one.best, is_credible(inquiry, analysis, *one.best, {one.direction})});
  weigh(analysis, all);
  std::stable_sort(singles.begin(), singles.end(), [](const Single& a, const Single& b) {
    return a.best.has_value() != b.best.has_value() ? a.best.has_value() : a.log_weight > b.log_weight;
  });
}

void weigh_credibility(const Inquiry& inquiry, const Analysis& analysis, std::vector<Group>& groups) {
  std::vector<Explained> all;
  for (Group& one : groups)
    all.push_back({&one.log_weight, &*one.refit, is_credible(inquiry, analysis, *one.refit, one.directions)});
  weigh(analysis, all);
  sort_by_weight(groups);
}

}  // namespace tunica::diagnosis
