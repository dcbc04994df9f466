// SPDX-License-Identifier: Apache-2.0
#include "budget/decision.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace tunica::budget {
namespace {

using diagnosis::Verdict;
using Contenders = std::vector<const Contender*>;

constexpr double unlikely = 0.01;  ///< of the probability of the likeliest

bool believed(const Contender& one) { return one.belief != Belief::beyond; }

double probability_of(const Contenders& some) {
  double sum = 0;
  for (const Contender* one : some) sum += one->probability;
  return sum;
}

/// Where no cause takes half by itself, one may take it beside others: by its own part in the steps.
Decision leading_by_steps(const Budget& budget) {
  if (budget.unlisted_probability > 1 - sure_enough) return {};
  std::map<std::string, double> parts;
  for (const Step& step : budget.steps) parts[step.id] += step.belief == Belief::beyond ? 0 : step.shapley;
  std::vector<std::pair<double, std::string>> ranking{{0, ""}, {0, ""}};
  for (const auto& [id, part] : parts) ranking.emplace_back(part, id);
  std::sort(ranking.rbegin(), ranking.rend());
  if (ranking[0].first < most_of_it || ranking[0].first < ranking[1].first + ahead) return {};
  // The place is that of the step: a mechanism may be a contender in another one, too.
  const Contender* lead = nullptr;
  for (const Contender& one : budget.contenders) {
    if (one.id != ranking[0].second || !believed(one)) continue;
    const bool is_step = std::ranges::any_of(
        budget.steps, [&](const Step& step) { return step.id == one.id && step.place == one.place; });
    if (is_step) return {Verdict::leading, {&one}};
    if (lead == nullptr) lead = &one;
  }
  return lead == nullptr ? Decision{} : Decision{Verdict::leading, {lead}};
}

/// The probability that is enough. What nobody would believe and takes far less is no reason to doubt, unless it has
/// most of the probability.
double enough(const Budget& budget, const Contender& top) {
  double incredible = 0;
  for (const Contender& one : budget.contenders)
    if (!believed(one) && one.share < top.share - ahead) incredible += one.probability;
  return sure_enough * (incredible < 0.5 ? 1 - incredible : 1);
}

/// Whether a cause leaves almost no relevant misfit, and some cause is present. Then no evidence is asked: what takes
/// far less needs an unlisted misfit several times as large as is tolerated.
bool is_enough_alone(const Budget& budget, const Contender& top) {
  constexpr double nearly_all = 0.95, half_again = 1.5;
  return budget.base.rms > budget.tolerance.share && top.share >= nearly_all &&
         top.rest.rms <= half_again * budget.tolerance.share && budget.unlisted_probability < 1 - sure_enough;
}

/// The probability that is asked: of all, or of the causes that are listed. Then the odds of an unlisted misfit are
/// three to one at most, and the base misses by more than anybody would tolerate. The sentence gives its probability.
double asked(const Budget& budget, double sure) {
  const bool may_be_said = budget.unlisted_probability <= may_be_unlisted && budget.base.rms > budget.tolerance.share;
  return may_be_said ? sure * (1 - budget.unlisted_probability) : sure;
}

/// What takes about as much as the best, less what the evidence excludes. Forms of the energy are many and alike: among
/// them it decides also where none is sure.
Contenders rivals_of(const Budget& budget, const Contender& top, double sure) {
  double likeliest = 0, likeliest_form = 0;
  for (const Contender& one : budget.contenders)
    if (one.share >= top.share - ahead) {
      if (believed(one)) likeliest = std::max(likeliest, one.probability);
      if (one.in_the_energy) likeliest_form = std::max(likeliest_form, one.probability);
    }
  Contenders rivals;
  for (const Contender& one : budget.contenders) {
    if (one.share < top.share - ahead) continue;
    const bool no_form = one.in_the_energy && one.probability < unlikely * likeliest_form;
    const bool more_but_incredible = !believed(one) && one.share > top.share;
    const bool excluded = !more_but_incredible && likeliest >= sure && one.probability < unlikely * likeliest;
    // Nobody would believe it, and it takes no more. The list of causes alone shows it.
    const bool incredible = !believed(one) && one.share <= top.share && one.probability < unlikely;
    if (!no_form && !excluded && !incredible) rivals.push_back(&one);
  }
  return rivals;
}

/// What leads where one test with parameters of its own competes with causes that are listed. It takes what any of them
/// takes there: it goes where they are sure without it and take as much, and leads where it is sure by itself.
Contenders with_another_state_judged(Contenders ties, double sure) {
  constexpr double as_much = 0.05;
  const auto is_state = [](const Contender* one) { return one->is_state(); };
  Contenders listed, states;
  std::partition_copy(ties.begin(), ties.end(), std::back_inserter(states), std::back_inserter(listed), is_state);
  if (states.empty()) return ties;
  double most = 0, listed_most = 0;
  for (const Contender* one : states) most = std::max(most, one->share);
  for (const Contender* one : listed)
    if (believed(*one)) listed_most = std::max(listed_most, one->share);
  if (probability_of(listed) >= sure && listed_most >= most - as_much) return listed;
  return probability_of(states) >= sure ? states : ties;
}

}  // namespace

Decision decided(const Budget& budget) {
  if (budget.rough || !(budget.base.rms > 0)) return {};
  if (budget.cheaper && budget.cheaper->own_share.value_or(0) < most_of_it) return {};
  const Contender* top = nullptr;
  for (const Contender& one : budget.contenders)
    if (believed(one) && (top == nullptr || one.share > top->share)) top = &one;
  if (top == nullptr) return {};
  for (const Contender& one : budget.contenders)
    if (one.share > top->share + ahead) return {};  // its name is not for the runner-up to have
  if (top->share < most_of_it) return leading_by_steps(budget);
  const double sure = asked(budget, enough(budget, *top));
  Contenders ties = rivals_of(budget, *top, sure);
  const bool alone = is_enough_alone(budget, *top);
  if (alone) std::erase_if(ties, [&](const Contender* one) { return one->probability < unlikely * top->probability; });
  ties = with_another_state_judged(std::move(ties), sure);
  if (std::none_of(ties.begin(), ties.end(), [](const Contender* one) { return believed(*one); })) return {};
  if (probability_of(ties) < sure && !alone) return {};
  std::stable_sort(ties.begin(), ties.end(), [](const Contender* a, const Contender* b) {
    return std::pair(!believed(*a), -a->probability) < std::pair(!believed(*b), -b->probability);
  });
  if (ties.front()->share < most_of_it) return {};
  // Of two tests, each in a state of its own is the same: they differ.
  std::set<std::string> answers, tests;
  for (const ChannelSize& channel : budget.base_channels) tests.insert(channel.test);
  for (const Contender* one : ties) answers.insert(one->is_state() && tests.size() == 2 ? one->sort : one->answer());
  return {answers.size() == 1 ? Verdict::leading : Verdict::indistinguishable, std::move(ties)};
}

}  // namespace tunica::budget
