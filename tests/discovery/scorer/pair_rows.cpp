// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "rows.hpp"

namespace blind::score {
namespace {

std::multiset<std::string> hidden_together(const std::vector<TrueEffect>& effects) {
  std::multiset<std::string> ids;
  for (const TrueEffect& effect : effects) ids.insert(effect.id);
  return ids;
}

/// Two that are hidden against those that are named.
struct Pairs {
  Share exact, found_false;
  /// `stands(k, id)`: whether the k-th of the names counts for a hidden one that has no name of its own yet.
  template <class Stands>
  void add(const std::vector<TrueEffect>& hidden, const std::vector<std::string>& names, Stands stands) {
    std::multiset<std::string> left = hidden_together(hidden);
    bool all_stand = true;
    for (std::size_t k = 0; k < names.size(); ++k) {
      auto meant = left.find(names[k]);
      if (meant == left.end())
        meant = std::find_if(left.begin(), left.end(), [&](const std::string& id) { return stands(k, id); });
      found_false.add(meant == left.end());
      all_stand = all_stand && meant != left.end();
      if (meant != left.end()) left.erase(meant);
    }
    exact.add(all_stand && left.empty());
  }
};

}  // namespace

void pair_rows(const Cases& cases, const LookAlikes& look_alikes, std::vector<Figure>& table) {
  Pairs counted, strict, oracle, certain;
  Share within;
  for (const Case& one : cases) {
    if (one.truth.set != "pairs" || one.truth.asked != 60) continue;
    const Verdict verdict = judged(one);
    std::vector<std::string> names;
    for (std::size_t k = 0; k < together(verdict); ++k) names.push_back(verdict.causes[k].id);
    counted.add(one.truth.effects, names,
                [&](std::size_t k, const std::string& id) { return stands_for(verdict, names[k], id, look_alikes); });
    strict.add(one.truth.effects, names, [](std::size_t, const std::string&) { return false; });
    if (verdict.verdict == "named")
      certain.add(one.truth.effects, names, [](std::size_t, const std::string&) { return false; });
    if (verdict.verdict != "unknown") {
      std::vector<std::vector<std::string>> offered = verdict.alternatives;
      offered.push_back(names);
      within.add(std::any_of(offered.begin(), offered.end(), [&](const auto& ids) {
        return std::multiset<std::string>(ids.begin(), ids.end()) == hidden_together(one.truth.effects);
      }));
    }
    if (!one.oracle || one.oracle->pair.empty()) continue;
    const auto& members = one.oracle->pair;
    oracle.add(one.truth.effects, {members[0].id, members[1].id},
               [&](std::size_t k, const std::string& id) { return stands_for(members[k], id, look_alikes); });
  }
  const auto remark = [&](Share Pairs::*which) {
    std::string words = fmt::format("without look-alikes {:.3f}", (strict.*which).value());
    if ((oracle.*which).total > 0) words += fmt::format(", oracle {:.3f}", (oracle.*which).value());
    return words;
  };
  table.push_back(share("two effects, exact pair, Λ 60 each", counted.exact, at_least(0.85), at_least(0.90),
                        remark(&Pairs::exact)));
  table.push_back(share("two effects, false discoveries among the causes named", counted.found_false, at_most(0.05), {},
                        remark(&Pairs::found_false)));
  table.push_back(share("two effects, false discoveries where the verdict is \"named\"", certain.found_false, {}, {},
                        fmt::format("without look-alikes; {} pairs", certain.exact.total)));
  table.push_back(share("two effects, the very pair is the first or an alternative", within, {}, {},
                        "of verdicts that are not \"unknown\""));
}

}  // namespace blind::score
