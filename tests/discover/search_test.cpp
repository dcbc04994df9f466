// SPDX-License-Identifier: Apache-2.0
// Which sets a search comes to.
#include "discovery/search.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "discover/fitting.hpp"

namespace tunica::discovery::search_test {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Not;
using trial::FittedRubber;
using trial::hidden;
using trial::ToFit;

using Names = std::vector<std::string>;

/// One rubber and the kinds that are searched in it.
class Searched {
 public:
  Searched(const ToFit& what, const Names& names) : rubber(what) {
    for (const std::string& name : names) kinds.push_back(rubber.kind(name));
  }
  [[nodiscard]] std::vector<CommonFit> with(const Search& request, const IsClean& is_clean) const {
    const CommonFitter fitter({&rubber.fitter}, {kinds}, rubber.subject.from_nothing);
    return search(fitter, request, is_clean);
  }

  const FittedRubber rubber;
  std::vector<KindPointer> kinds;
};

std::vector<Names> names_of(const std::vector<CommonFit>& sets) {
  std::vector<Names> all;
  for (const CommonFit& set : sets) {
    Names& names = all.emplace_back();
    for (const KindPointer& kind : set.kinds) names.push_back(kind->name);
  }
  return all;
}

std::size_t largest(const std::vector<CommonFit>& sets) {
  std::size_t size = 0;
  for (const CommonFit& set : sets) size = std::max(size, set.kinds.size());
  return size;
}

const IsClean always = [](const CommonFit&) { return true; }, never = [](const CommonFit&) { return false; };

/// A cubic term in I1 and one in I2.
ToFit two_terms(const std::string& law = "linear",
                const std::vector<std::pair<std::string, double>>& parameters = {{"mu", 60}}) {
  return {.hide =
              [=](nlohmann::json& experiment) {
                hidden("I2", law, parameters)(experiment);
                nlohmann::json second = {{"type", "added_term"},
                                         {"as", "second"},
                                         {"invariant", "I1"},
                                         {"law", "cubic"},
                                         {"parameters", {{"k", {{"initial", 1}}}}}};
                experiment["models"]["rubber"]["mechanisms"].push_back(second);
              },
          .sd = 3};
}

/// Every set once, with its kinds in the order of their names, likeliest first; singles and pairs are all tried.
TEST(SearchForTerms, TriesAllSinglesAndPairs) {
  const Names names{"I1_cubic", "I1_quadratic", "I2_linear", "I2_quadratic"};
  const Searched one(two_terms(), names);
  const std::vector<CommonFit> sets = one.with({2}, never);
  EXPECT_EQ(names_of(sets).front(), (Names{"I1_cubic", "I2_linear"}));
  std::set<Names> seen;
  for (const Names& set : names_of(sets)) {
    EXPECT_TRUE(std::is_sorted(set.begin(), set.end()));
    EXPECT_TRUE(seen.insert(set).second);
  }
  for (std::size_t k = 1; k < sets.size(); ++k) EXPECT_GE(sets[k - 1].log_evidence, sets[k].log_evidence);
  EXPECT_EQ(largest(sets), 2U);
  // Whatever can be fitted alone is there, and every pair within 10 of the best single.
  const Fitter& fitter = one.rubber.fitter;
  double best_single = -INFINITY;
  for (const KindPointer& kind : one.kinds)
    if (const auto single = fitter.grown(fitter.root(), kind, -INFINITY)) {
      EXPECT_THAT(seen, Contains(Names{kind->name}));
      best_single = std::max(best_single, single->log_evidence);
    }
  for (const KindPointer& a : one.kinds)
    for (const KindPointer& b : one.kinds) {
      const auto single = a->name < b->name ? fitter.grown(fitter.root(), a, -INFINITY) : std::nullopt;
      if (single && fitter.grown(*single, b, best_single - 10)) {
        EXPECT_THAT(seen, Contains(Names{a->name, b->name}));
      }
    }
}

TEST(SearchForTerms, KeepsToTheNumberOfTerms) {
  const Searched one(two_terms(), {"I1_cubic", "I2_linear", "I2_quadratic"});
  const auto singles = one.with({1}, never);
  ASSERT_FALSE(singles.empty());
  EXPECT_EQ(largest(one.with({2}, never)), 2U);
}

/// Parameters of the terms together: an exponential has two.
TEST(SearchForTerms, KeepsToTheNumberOfParameters) {
  const Searched one(two_terms("exponential", {{"mu", 30}, {"b", 0.1}}), {"I1_cubic", "I2_exponential"});
  const Names both{"I1_cubic", "I2_exponential"};
  for (const std::size_t unlimited : {0U, 3U, 4U})
    EXPECT_THAT(names_of(one.with({3, unlimited}, never)), Contains(both));
  const auto two = names_of(one.with({3, 2}, never));
  EXPECT_THAT(two, Not(Contains(both)));
  EXPECT_THAT(two, Contains(Names{"I2_exponential"}));
  EXPECT_THAT(names_of(one.with({3, 1}, never)), ElementsAre(Names{"I1_cubic"}));
}

/// Where the best pair is no better than the best single term, and that leaves noise, larger sets are not tried.
TEST(SearchForTerms, StopsWhereNothingIsLeftToExplain) {
  const Searched one({.hide = hidden("I2", "linear", {{"mu", 40}}), .sd = 3},
                     {"I1_cubic", "I2_linear", "I1_quadratic", "I2_quadratic", "stretches_rising"});
  std::vector<std::size_t> asked;
  const auto sets = one.with({3}, [&](const CommonFit& set) {
    asked.push_back(set.kinds.size());
    return true;
  });
  EXPECT_EQ(names_of(sets).front(), (Names{"I2_linear"}));
  EXPECT_THAT(asked, ElementsAre(1U));
}

/// From nothing an isotropic term comes first, and a second one of the same kind is no other set but for powers.
TEST(SearchForTerms, FromNothingBeginsWithWhatHoldsTogether) {
  ToFit what{.hide = hidden("I2", "linear", {{"mu", 60}}), .sd = 3};
  what.from_nothing = true;
  const Searched one(what, {"I1_linear", "I2_linear", "fibre_circumferential_quadratic"});
  const auto sets = names_of(one.with({3}, never));
  EXPECT_EQ(sets.front(), (Names{"I1_linear", "I2_linear"}));
  EXPECT_THAT(sets, Not(Contains(Names{"fibre_circumferential_quadratic"})));
  for (const Names& names : sets) EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

TEST(SearchForTerms, MayHaveTwoPowersOfTheStretches) {
  ToFit what{.hide = hidden("stretches", "power", {{"mu", 4}, {"alpha", 5}}), .sd = 3};
  what.from_nothing = true;
  const Searched one(what, {"stretches_rising"});
  const auto sets = names_of(one.with({2}, never));
  EXPECT_EQ(sets.front(), (Names{"stretches_rising", "stretches_rising"})) << "μ/2 λ² and another";
}

/// A power of the stretches next to ±2 stands for a linear law: both are there.
TEST(SearchForTerms, PutsLinearLawsForPowers) {
  ToFit what{.hide = hidden("I2", "linear", {{"mu", 60}}), .sd = 3};
  what.from_nothing = true;
  const Searched one(what, {"I1_linear", "I2_linear", "stretches_falling", "stretches_rising"});
  const auto sets = names_of(one.with({2}, never));
  EXPECT_EQ(sets.front(), (Names{"I1_linear", "I2_linear"}));
  EXPECT_THAT(sets, Contains(Names{"stretches_falling", "stretches_rising"}));
}

/// Nothing helps where nothing is missing: an empty list.
TEST(SearchForTerms, FindsNothingThatHasNothingToDo) {
  const Searched one({.sd = 1e-9}, {"I2_linear", "I1_cubic"});
  EXPECT_TRUE(one.with({3}, never).empty());
}

}  // namespace
}  // namespace tunica::discovery::search_test
