// SPDX-License-Identifier: Apache-2.0
#include "discovery/next.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "diagnosis/prospects/separation.hpp"
#include "diagnosis/prospects/undetermined.hpp"
#include "discovery/verdict.hpp"

namespace tunica::discovery {
namespace {

constexpr std::size_t most_rivals = 3;

std::set<std::string> invariants_of(const SetFit& set) {
  std::set<std::string> words;
  for (const KindPointer& kind : set.kinds) words.insert(kind->invariant_words());
  return words;
}

/// The best set, and the likeliest of the ambiguity set that differ from it.
std::vector<const SetFit*> rivals_of(const Discovery& found, const std::vector<SetFit>& sets, bool by_invariant) {
  std::vector<const SetFit*> rivals{&sets.front()};
  for (const SetFit& set : sets) {
    if (&set == &sets.front() || rivals.size() == most_rivals) continue;
    const bool credible = std::any_of(found.judgement.ambiguity.begin(), found.judgement.ambiguity.end(),
                                      [&](const Alternative& one) { return one.kinds == set.kinds; });
    const bool other = std::none_of(rivals.begin(), rivals.end(), [&](const SetFit* one) {
      return by_invariant && invariants_of(*one) == invariants_of(set);
    });
    if (credible && other) rivals.push_back(&set);
  }
  return rivals;
}

}  // namespace

std::string next_experiment(const diagnosis::Inquiry& inquiry, const Discovery& found,
                            const std::vector<SetFit>& sets) {
  if (found.terms.empty() || sets.empty()) return "";
  std::vector<const SetFit*> rivals = rivals_of(found, sets, true);
  if (rivals.size() < 2) rivals = rivals_of(found, sets, false);
  if (rivals.size() < 2) return "";
  std::vector<diagnosis::FittedRival> fitted;
  std::string words;
  for (const SetFit* set : rivals) {
    fitted.push_back({set->set->assembly(), diagnosis::all_variables(set->set->assembly()), set->fit});
    words += (words.empty() ? "" : ", or ") + words_of(set->kinds);
  }
  inquiry.report("the next experiment", 0.95);
  const auto best = diagnosis::separating_design(inquiry, found.analysis.evidence, fitted);
  if (!best)
    return fmt::format("No strip, sheet or inflation of the library tells in {} repeats whether the energy has {}.",
                       diagnosis::most_repeats, words);
  return fmt::format("{}, {}, tells whether the energy has {}; these differ by {:.1f} σ there.", best->design,
                     best->repeats == 1 ? "once" : fmt::format("{} times", best->repeats), words, best->sigmas);
}

}  // namespace tunica::discovery
