// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "diagnosis/detection/analysis.hpp"
#include "discovery/set_fit.hpp"

/// The common part of a search in one specimen and in several.
namespace tunica::discovery {

/// Throws InputError where no model is named, or no plugin can write terms.
void check(const Request& request, const plugins::Catalogue& catalogue);

/// Throws InputError where terms would have to be found from nothing for a specimen in several states.
void check_states(const Request& request, const experiment::Experiment& experiment);

/// The analysis of the base; rows that are gross take no part.
diagnosis::Analysis screened(const diagnosis::Inquiry& inquiry);

/// Whether the material that the file describes has directions of its own.
bool has_directions(const experiment::Experiment& experiment, const std::string& name,
                    const plugins::Catalogue& catalogue);

/// Whether the material that the file describes changes its volume, by itself or by a mechanism.
bool changes_volume(const experiment::Experiment& experiment, const std::string& name,
                    const plugins::Catalogue& catalogue);

/// Throws InputError where terms of several specimens would have to be found from nothing for such a material.
void check_volume(const Request& request, const experiment::Experiment& experiment,
                  const plugins::Catalogue& catalogue);

/// Whether that material changes its volume by itself, and the data show it.
bool sees_volume(const Subject& subject, const diagnosis::Evidence& evidence);

/// What is searched, with amplitudes that the data can hold.
std::vector<KindPointer> scaled_kinds(const Fitter& fitter, std::vector<Kind> kinds);

/// Of sets of the same invariants whose 2 ln E is within 3 of the best, the one with the fewest parameters comes first
/// if what it leaves is as clean: a law is not preferred to its own limit.
template <class Set, class IsClean>
void simplest_first(std::vector<Set>& sets, const IsClean& is_clean) {
  constexpr double as_likely = 1.5;
  const auto invariants = [](const Set& set) {
    std::set<std::string> words;
    for (const KindPointer& kind : set.kinds) words.insert(kind->invariant_words());
    return words;
  };
  std::size_t first = 0;
  for (std::size_t k = 1; k < sets.size() && sets[k].log_evidence > sets.front().log_evidence - as_likely; ++k)
    if (sets[k].parameter_count() < sets[first].parameter_count() && invariants(sets[k]) == invariants(sets.front()) &&
        (is_clean(sets[k]) || !is_clean(sets[first])))
      first = k;
  std::rotate(sets.begin(), sets.begin() + static_cast<std::ptrdiff_t>(first),
              sets.begin() + static_cast<std::ptrdiff_t>(first) + 1);
}

}  // namespace tunica::discovery
