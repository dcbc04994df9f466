// SPDX-License-Identifier: Apache-2.0
#include "budget/tie.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "budget/output/outputs.hpp"

namespace tunica::budget {
namespace {

/// The causes with their places; powers of the stretches that act like different invariants have one name.
std::vector<std::string> names_of(const Ties& ties) {
  std::map<std::string, int> named;
  for (const Contender* one : ties) ++named[one->id + place_words(one->place)];
  std::vector<std::string> names;
  for (const Contender* one : ties) {
    const std::string where = place_words(one->place);
    names.push_back(one->id + (named[one->id + where] > 1 ? ", acting like " + one->sort : "") + where);
  }
  return names;
}

const char* doubt_of(const Contender& contender) {
  return contender.belief == Belief::beyond ? " (beyond belief)" : "";
}

}  // namespace

Ties tied(const Ties& first) {
  Ties all;
  std::set<std::string> answers;
  for (const Contender* one : first)
    if (answers.insert(one->answer()).second) all.push_back(one);
  return all;
}

std::string tie_words(const Budget& budget, const Ties& ties) {
  std::vector<std::string> parts = names_of(ties);
  for (std::size_t k = 0; k < ties.size(); ++k)
    parts[k] += fmt::format(" {}{}{}", percent(ties[k]->share), price(*ties[k]), doubt_of(*ties[k]));
  const std::string rest = remains(budget.rest(), budget.tolerance);
  if (parts.size() == 1)
    return fmt::format("{} takes so much of {}, but what may look like it was not looked for; {}", parts.front(),
                       the_misfit(budget), rest);
  return fmt::format("alone, these take so much of {} that none is clearly ahead: {}; {}", the_misfit(budget),
                     fmt::join(parts, ", "), rest);
}

void claim_tie(const Ties& ties, const std::vector<std::string>& unseen, diagnosis::Claim& claim) {
  const auto add = [&](const std::string& id, const std::string& words) {
    claim.in_words.push_back(words);
    if (std::ranges::find(claim.ambiguity_set, id) != claim.ambiguity_set.end()) return;
    claim.ambiguity_set.push_back(id);
    claim.look_alikes.push_back({id});
  };
  const std::vector<std::string> names = names_of(ties);
  for (std::size_t k = 0; k < ties.size(); ++k) add(ties[k]->id, names[k] + doubt_of(*ties[k]));
  for (const std::string& id : unseen) add(id, id);
}

std::string isolated_by(const std::string& id, const plugins::Catalogue& catalogue) {
  const auto found = catalogue.mechanisms().find(id);
  return found == catalogue.mechanisms().end() ? "" : found->second.factory.isolated_by;
}

std::vector<std::string> switches(const Ties& ties, const plugins::Catalogue& catalogue) {
  std::vector<std::string> all;
  std::set<std::string> said;
  for (const Contender* one : ties) {
    const std::string how = isolated_by(one->id, catalogue);
    if (one->belief == Belief::beyond || how.empty() || !said.insert(one->id).second) continue;
    std::string where;
    for (const Contender* other : ties)
      if (other->id == one->id && other->belief != Belief::beyond && !other->place.tests.empty())
        where += (where.empty() ? " " : " or ") + other->place.words();
    all.push_back(fmt::format("{}{}: {}", one->id, where, how));
  }
  return all;
}

}  // namespace tunica::budget
