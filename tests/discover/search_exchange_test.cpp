// SPDX-License-Identifier: Apache-2.0
// Sets of terms whose shares of the data are known: which are grown, and which take the place of others.
#include <cmath>

#include <gmock/gmock.h>

#include "discover/made_up_terms.hpp"
#include "discovery/search.hpp"

namespace tunica::discovery::search_exchange_test {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::UnorderedElementsAre;
using trial::in_blocks;
using trial::MadeUpTerms;
using trial::over_blocks;

using Names = std::vector<std::string>;
using Kinds = std::vector<KindPointer>;

const IsClean always = [](const CommonFit&) { return true; }, never = [](const CommonFit&) { return false; };

std::vector<CommonFit> searched(const MadeUpTerms& terms, const Kinds& kinds, const Search& request,
                                const IsClean& is_clean = never) {
  const CommonFitter fitter({terms.fitter.get()}, {kinds}, true);
  return search(fitter, request, is_clean);
}

std::vector<Names> names_of(const std::vector<CommonFit>& sets) {
  std::vector<Names> all;
  for (const CommonFit& set : sets) {
    Names& names = all.emplace_back();
    for (const KindPointer& kind : set.kinds) names.push_back(kind->name);
  }
  return all;
}

std::vector<Names> of_size(std::size_t size, const std::vector<CommonFit>& sets) {
  std::vector<Names> some = names_of(sets);
  std::erase_if(some, [&](const Names& names) { return names.size() != size; });
  return some;
}

/// |r|² falls by ten times the square of the level of a block.
double level_of(double gain) { return std::sqrt(gain / 10); }

/// a, b, … each in a block of its own.
std::map<std::string, trial::MadeUpLaw> laws_of_blocks(std::size_t count) {
  std::map<std::string, trial::MadeUpLaw> laws;
  for (std::size_t k = 0; k < count; ++k) laws[std::string(1, static_cast<char>('a' + k))] = in_blocks({k});
  return laws;
}

/// What begins in a block that shows nothing, and turns to where the data are: no fit grows into it.
trial::MadeUpLaw turning(std::size_t nothing, const std::vector<double>& values) {
  return {[=](std::size_t block, double s) {
            const double there = block < values.size() ? values[block] : 0;
            return std::cos(s) * (block == nothing ? 1 : 0) + std::sin(s) * there;
          },
          "s"};
}

/// Of 21 pairs larger sets grow from the best 16: the only triple without any of these is not tried.
TEST(SearchForSets, GrowsFromTheBestSixteen) {
  const MadeUpTerms terms(std::vector<double>(7, 2), laws_of_blocks(7));
  const std::vector<double> price{0, 0.1, 0.2, 0.3, 0.5, 0.6, 0.8};
  Kinds kinds;
  for (std::size_t k = 0; k < 7; ++k) {
    const std::string name(1, static_cast<char>('a' + k));
    kinds.push_back(terms.kind(name, name, -price[k]));
  }
  const auto sets = searched(terms, kinds, {3});
  EXPECT_EQ(of_size(1, sets).size(), 7U);
  EXPECT_EQ(of_size(2, sets).size(), 21U);
  EXPECT_EQ(of_size(3, sets).size(), 34U);
  EXPECT_EQ(sets.size(), 7U + 21 + 34);
  EXPECT_THAT(names_of(sets), Not(Contains(Names{"e", "f", "g"})));
  EXPECT_EQ(names_of(sets).front(), (Names{"a", "b", "c"}));
}

/// No set is fitted twice, whichever way leads to it.
TEST(SearchForSets, TriesEachOnce) {
  const MadeUpTerms terms(std::vector<double>(5, 2), laws_of_blocks(5));
  Kinds kinds;
  for (const char* name : {"a", "b", "c", "d", "e"}) kinds.push_back(terms.kind(name, name));
  const CommonFitter fitter({terms.fitter.get()}, {kinds}, true);
  terms.forget();
  (void)fitter.grown(fitter.root(), kinds[0], -INFINITY);
  const int once = terms.made().begin()->second;
  terms.forget();
  EXPECT_EQ(searched(terms, kinds, {3}).size(), 5U + 10 + 10);
  for (const auto& [names, times] : terms.made()) EXPECT_EQ(times, once) << ::testing::PrintToString(names);
  EXPECT_EQ(terms.made().size(), 5U + 10 + 10);
}

/// Of 28 pairs 21 take much. What h promises beside one of these is less than the sixteenth best pair says.
TEST(SearchForSets, FitsNothingThatCannotBeAmongTheBest) {
  std::vector<double> levels(7, 10);
  levels.push_back(level_of(8));
  const MadeUpTerms terms(levels, laws_of_blocks(8));
  Kinds kinds;
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g", "h"}) kinds.push_back(terms.kind(name, name));
  const auto sets = names_of(searched(terms, kinds, {2}));
  EXPECT_THAT(sets, Contains(Names{"h"}));
  EXPECT_THAT(sets, Contains(Names{"f", "g"}));
  EXPECT_THAT(sets, Not(Contains(Names{"a", "h"})));
  EXPECT_EQ(terms.made().at({"a", "h"}), 1) << "its promise";
  EXPECT_EQ(terms.made().at({"f", "g"}), 1) << "its promise, of which its fit begins";
}

/// a1 … a4 and b1 … b4, each less likely than the one before.
Kinds copies_of_a_and_b(const MadeUpTerms& terms) {
  Kinds kinds;
  const std::vector<double> of_a{0, 0.3, 0.6, 0.9}, of_b{0, 0.33, 0.69, 1.11};
  for (std::size_t k = 0; k < 4; ++k) {
    kinds.push_back(terms.kind("a" + std::to_string(k + 1), "a", -of_a[k]));
    kinds.push_back(terms.kind("b" + std::to_string(k + 1), "b", -of_b[k]));
  }
  return kinds;
}

/// Four copies of a and of b fill the places that triples grow from. In the best six of what comes of them each term
/// makes room, and so c and d come together.
TEST(SearchForSets, MakeRoomInTheBestSix) {
  const MadeUpTerms terms({level_of(90), level_of(90), level_of(84), level_of(77)}, laws_of_blocks(4));
  Kinds kinds = copies_of_a_and_b(terms);
  kinds.push_back(terms.kind("c", "c"));
  kinds.push_back(terms.kind("d", "d"));
  const auto sets = searched(terms, kinds, {3});
  std::vector<Names> expected;
  for (const char* a : {"a1", "a2", "a3", "a4"})
    for (const char* b : {"b1", "b2", "b3", "b4"})
      for (const char* last : {"c", "d"}) expected.push_back({a, b, last});
  for (const char* one : {"a1", "a2", "a3", "b1", "b2", "b3"}) expected.push_back({one, "c", "d"});
  EXPECT_THAT(of_size(3, sets), ::testing::UnorderedElementsAreArray(expected));
  EXPECT_TRUE(of_size(4, sets).empty());
}

/// c and d say little alone and much together. They come together when the best sets make room, are then the best
/// themselves, and make room in their turn.
TEST(SearchForSets, MakeRoomInWhatCameOfIt) {
  auto laws = laws_of_blocks(2);
  laws["c"] = over_blocks({0, 0, 1, 2});
  laws["d"] = over_blocks({0, 0, 1, -2});
  const MadeUpTerms terms({level_of(70), level_of(66), level_of(110), 0}, laws);
  Kinds kinds = copies_of_a_and_b(terms);
  kinds.push_back(terms.kind("c", "c"));
  kinds.push_back(terms.kind("d", "d", -1));
  const auto sets = searched(terms, kinds, {3});
  EXPECT_EQ(names_of(sets).front(), (Names{"a1", "c", "d"}));
  EXPECT_THAT(names_of(sets), IsSupersetOf({Names{"a4", "c", "d"}, Names{"b4", "c", "d"}}));
}

/// From the unlikely one of the two the way to the pair is too long.
TEST(SearchForSets, GrowsFromTheLikeliestFirst) {
  const MadeUpTerms terms({level_of(400), level_of(30)}, laws_of_blocks(2));
  EXPECT_THAT(names_of(searched(terms, {terms.kind("unlikely", "b", -1000), terms.kind("z", "a")}, {2})),
              UnorderedElementsAre(Names{"z"}, Names{"unlikely"}, Names{"unlikely", "z"}));
  EXPECT_THAT(names_of(searched(terms, {terms.kind("z", "b", -1000), terms.kind("likely", "a")}, {2})),
              Contains(Names{"likely", "z"}));
}

/// A set may be behind the best one so far.
TEST(SearchForSets, TriesWhatIsALittleBehind) {
  const MadeUpTerms terms({level_of(160), level_of(5.5)}, laws_of_blocks(2));
  EXPECT_THAT(names_of(searched(terms, {terms.kind("a", "a"), terms.kind("b", "b", -3)}, {2})),
              Contains(Names{"a", "b"}));
}

/// While the last term was worth its price, or more than noise is left.
TEST(SearchForSets, GrowsWhileItPays) {
  const MadeUpTerms one({level_of(160), level_of(6), level_of(6)}, laws_of_blocks(3));
  const Kinds kinds{one.kind("a", "a"), one.kind("b", "b", -5), one.kind("c", "c", -5)};
  const auto stopped = searched(one, kinds, {3}, always);
  EXPECT_EQ(names_of(stopped).front(), Names{"a"});
  EXPECT_THAT(names_of(stopped), Contains(Names{"a", "b"}));
  EXPECT_TRUE(of_size(3, stopped).empty());
  EXPECT_EQ(of_size(3, searched(one, kinds, {3}, never)).size(), 1U);

  const MadeUpTerms two({level_of(160), level_of(160), level_of(6)}, laws_of_blocks(3));
  std::vector<std::size_t> asked;
  const auto sets =
      searched(two, {two.kind("a", "a"), two.kind("b", "b"), two.kind("c", "c", -5)}, {3}, [&](const CommonFit& set) {
        asked.push_back(set.kinds.size());
        return true;
      });
  EXPECT_EQ(names_of(sets).front(), (Names{"a", "b"}));
  EXPECT_THAT(names_of(sets), Contains(Names{"a", "b", "c"}));
  EXPECT_THAT(asked, ElementsAre(2U));
}

TEST(SearchForSets, HasNoMoreTermsThanAreAskedFor) {
  const MadeUpTerms terms(std::vector<double>(4, 3), laws_of_blocks(4));
  Kinds kinds;
  for (const char* name : {"a", "b", "c", "d"}) kinds.push_back(terms.kind(name, name));
  EXPECT_EQ(searched(terms, kinds, {1}).size(), 4U);
  EXPECT_EQ(searched(terms, kinds, {2}).size(), 4U + 6);
  EXPECT_EQ(searched(terms, kinds, {3}).size(), 4U + 6 + 4);
  EXPECT_EQ(searched(terms, kinds, {4}).size(), 4U + 6 + 4 + 1);
}

/// The heights of a curve count as parameters.
TEST(SearchForSets, CountsTheHeightsOfCurves) {
  auto laws = laws_of_blocks(1);
  laws["one"] = laws["other"] = in_blocks({0});
  laws["one"].heights = {[](std::size_t block) { return block == 1 ? 1.0 : 0.0; },
                         [](std::size_t block) { return block == 2 ? 1.0 : 0.0; }};
  laws["other"] = in_blocks({3});
  laws["other"].heights = {[](std::size_t block) { return block == 4 ? 1.0 : 0.0; },
                           [](std::size_t block) { return block == 5 ? 1.0 : 0.0; }};
  const MadeUpTerms terms(std::vector<double>(6, 3), laws);
  const Kinds kinds{terms.kind("one", "one"), terms.kind("other", "other")};
  EXPECT_THAT(names_of(searched(terms, kinds, {2, 3})), UnorderedElementsAre(Names{"one"}, Names{"other"}));
  EXPECT_THAT(names_of(searched(terms, kinds, {2, 6})), Contains(Names{"one", "other"}));
}

/// Fibres hold nothing together alone; beside what does they are terms as others.
TEST(SearchForSets, HaveFibresBesideWhatHoldsTogether) {
  const MadeUpTerms terms({3, 3, 3}, laws_of_blocks(3));
  const auto sets = searched(
      terms, {terms.kind("a", "a"), terms.kind("f", "b", 0, "fibre", "f"), terms.kind("g", "c", 0, "fibre", "g")}, {3});
  EXPECT_THAT(names_of(sets), UnorderedElementsAre(Names{"a"}, Names{"a", "f"}, Names{"a", "g"}, Names{"a", "f", "g"}));
}

/// In the best six sets a falling power becomes the linear law of I2, once whichever power it was. That law is too
/// unlikely to grow from, and no set of fibres leads there.
TEST(SearchForSets, HaveALinearLawForAPower) {
  auto laws = laws_of_blocks(7);
  laws["alpha"] = {[](std::size_t block, double alpha) {
                     return block == 0 ? alpha / 2 : block == 1 ? 1 + alpha / 3 : 0;
                   },
                   "alpha"};
  const MadeUpTerms terms({3, 0, 3, 3, 3, 3, 3}, laws);
  Kinds kinds{terms.kind("I2_linear", "a", -1000, "I2"), terms.kind("I1_linear", "b", -1000),
              terms.power("stretches_falling", true), terms.power("steeper", true, -0.01)};
  const std::vector<double> price{0, 0.1, 0.2, 0.4, 0.8};
  for (std::size_t k = 0; k < 5; ++k) {
    const std::string name(1, static_cast<char>('v' + k));
    kinds.push_back(terms.kind(name, std::string(1, static_cast<char>('c' + k)), -price[k], "fibre", name));
  }
  const CommonFitter fitter({terms.fitter.get()}, {kinds}, true);
  (void)fitter.grown(fitter.root(), kinds[0], -INFINITY);
  const int once = terms.made().at({"I2_linear"});
  terms.forget();
  const auto sets = searched(terms, kinds, {3});
  EXPECT_EQ(names_of(sets).front(), (Names{"stretches_falling", "v", "w"}));
  std::vector<Names> linear = names_of(sets);
  std::erase_if(linear, [](const Names& names) { return names.front() != "I2_linear"; });
  EXPECT_THAT(linear, UnorderedElementsAre(Names{"I2_linear"}, Names{"I2_linear", "v", "w"},
                                           Names{"I2_linear", "v", "x"}, Names{"I2_linear", "w", "x"}));
  EXPECT_EQ(terms.made().at({"I2_linear", "v", "w"}), once);
  EXPECT_THAT(of_size(3, sets), Each(Not(Contains("I1_linear"))));
}

/// At once, where nothing else is new; and only powers stand for a linear law.
TEST(SearchForSets, HaveALinearLawForPowersOnly) {
  auto laws = laws_of_blocks(4);
  laws["alpha"] = {[](std::size_t block, double alpha) {
                     return block == 0 ? alpha / 2 : block == 1 ? 1 - alpha / 3 : 0;
                   },
                   "alpha"};
  const MadeUpTerms terms({3, 0, 3, 3}, laws);
  const Kinds kinds{terms.kind("I1_linear", "a", -1000), terms.kind("v", "c", 0, "fibre", "v"),
                    terms.kind("w", "d", 0, "fibre", "w")};
  const Names linear{"I1_linear", "v", "w"};
  Kinds with_power = kinds, with_law = kinds;
  with_power.push_back(terms.power("stretches_rising", false));
  EXPECT_THAT(names_of(searched(terms, with_power, {3})), Contains(linear));
  with_law.push_back(terms.kind("a", "a"));
  const auto without = names_of(searched(terms, with_law, {3}));
  EXPECT_THAT(without, Contains(Names{"a", "v", "w"}));
  EXPECT_THAT(without, Not(Contains(linear)));
}

/// It is not put beside itself.
TEST(SearchForSets, HaveALinearLawOnce) {
  auto laws = laws_of_blocks(1);
  laws["alpha"] = {[](std::size_t block, double alpha) {
                     return block == 0 ? alpha / 2 : block == 1 ? 1.0 : block == 2 ? (alpha - 3) / 3 : 0;
                   },
                   "alpha"};
  const MadeUpTerms terms({6, 2, 0}, laws);
  EXPECT_THAT(
      names_of(searched(terms, {terms.kind("I1_linear", "a"), terms.power("stretches_rising", false)}, {2})),
      UnorderedElementsAre(Names{"I1_linear"}, Names{"stretches_rising"}, Names{"I1_linear", "stretches_rising"}));
}

/// Two laws of an invariant add up to a third, which no set grows into.
TEST(SearchForSets, HaveOneLawForAllOfAnInvariant) {
  auto laws = laws_of_blocks(3);
  laws["whole"] = turning(3, {1, 1});
  laws["absent"] = in_blocks({3});
  const MadeUpTerms terms({3.1, 3.1, 3, 0}, laws);
  const Kinds kinds{terms.kind("whole", "whole", 0, "I1", "p"), terms.kind("p", "a", 0, "I1", "p"),
                    terms.kind("q", "b", 0, "I1", "p"), terms.kind("x", "c"),
                    terms.kind("absent", "absent", 0, "I1", "p")};
  const CommonFitter fitter({terms.fitter.get()}, {kinds}, true);
  (void)fitter.grown(fitter.root(), kinds[1], -INFINITY);
  const int once = terms.made().at({"p"});
  terms.forget();
  const auto sets = searched(terms, kinds, {2});
  EXPECT_THAT(names_of(sets), UnorderedElementsAre(Names{"p"}, Names{"q"}, Names{"x"}, Names{"p", "q"}, Names{"p", "x"},
                                                   Names{"q", "x"}, Names{"whole"}, Names{"whole", "x"}));
  EXPECT_EQ(names_of(sets).front(), (Names{"whole", "x"}));
  for (const auto& [names, times] : terms.made())
    if (names != Names{"t"}) {  // a law alone, of which only the slope is asked
      EXPECT_LE(times, 2 * once) << ::testing::PrintToString(names) << ": grown, and put in place of others";
    }
  EXPECT_EQ(terms.made().at({"p", "q"}), once);
}

/// Fits of the same rows with another noise begin where these ended; nothing else of the search changes.
TEST(SearchForSets, BeginsWithTheSetsOfAnotherNoise) {
  const MadeUpTerms terms(std::vector<double>(4, 2), laws_of_blocks(4));
  Kinds kinds;
  for (const char* name : {"a", "b", "c", "d"}) kinds.push_back(terms.kind(name, name));
  const auto all = searched(terms, kinds, {3}), singles = searched(terms, kinds, {1});
  for (const auto* before : {&all, &singles}) {
    const auto again = searched(terms, kinds, {3, 0, before});
    EXPECT_EQ(names_of(again), names_of(all));
    EXPECT_NEAR(again.front().log_evidence, all.front().log_evidence, 1e-6);
  }
}

/// It takes the place of others in the best six sets.
TEST(SearchForSets, HaveOneLawInTheBestSix) {
  std::map<std::string, trial::MadeUpLaw> laws = laws_of_blocks(3);
  laws["whole"] = turning(3, {1, 1});
  const MadeUpTerms terms({3, 3, 2, 0}, laws);
  Kinds kinds{terms.kind("p", "a", 0, "I1", "p"), terms.kind("whole", "whole", 0, "I1", "p")};
  for (int k = 1; k <= 8; ++k) kinds.push_back(terms.kind("x" + std::to_string(k), "c", -0.1 * k));
  std::vector<Names> whole = names_of(searched(terms, kinds, {2}));
  std::erase_if(whole, [](const Names& names) { return names.front() != "whole"; });
  EXPECT_THAT(whole, UnorderedElementsAre(Names{"whole", "x1"}, Names{"whole", "x2"}, Names{"whole", "x3"},
                                          Names{"whole", "x4"}, Names{"whole", "x5"}, Names{"whole", "x6"}));
}

/// Also where the set without the invariant is likelier.
TEST(SearchForSets, HaveOneLawInSetsBehindOthers) {
  std::map<std::string, trial::MadeUpLaw> laws = laws_of_blocks(3);
  laws["whole"] = turning(3, {1, 1});
  const MadeUpTerms terms({3, 3, 3, 0}, laws);
  const auto sets = names_of(searched(
      terms, {terms.kind("p", "a", -48, "I1", "p"), terms.kind("whole", "whole", 0, "I1", "p"), terms.kind("x", "c")},
      {2}));
  EXPECT_THAT(sets, UnorderedElementsAre(Names{"p"}, Names{"x"}, Names{"p", "x"}, Names{"whole"}, Names{"whole", "x"}));
}

/// What came of it makes room as well: z is nothing beside p, and has something to do beside the other law.
TEST(SearchForSets, MakeRoomForWhatSuitsAnotherLaw) {
  std::map<std::string, trial::MadeUpLaw> laws = laws_of_blocks(3);
  laws["whole"] = turning(3, {1, -0.5});
  const MadeUpTerms terms({3, 0, std::sqrt(2.0), 0}, laws);
  const auto sets = searched(terms,
                             {terms.kind("p", "a", 0, "I1", "p"), terms.kind("whole", "whole", 0, "I1", "p"),
                              terms.kind("x", "c"), terms.kind("z", "b")},
                             {2});
  EXPECT_THAT(names_of(sets), Contains(Names{"whole", "z"}));
  EXPECT_THAT(names_of(sets), Not(Contains(Names{"p", "z"})));
}

/// Laws take the place of others in one invariant after the other, twice at most.
TEST(SearchForSets, ExchangeLawsTwice) {
  std::map<std::string, trial::MadeUpLaw> laws{{"p", in_blocks({0})},
                                               {"q", in_blocks({2})},
                                               {"r", in_blocks({4})},
                                               {"of_p", turning(6, {1, 1})},
                                               {"of_q", turning(6, {0, 0, 1, 1})},
                                               {"of_r", turning(6, {0, 0, 0, 0, 1, 1})}};
  const MadeUpTerms terms({3, 3, 3, 3, 3, 3, 0}, laws);
  Kinds kinds;
  for (const char* name : {"p", "q", "r"}) {
    kinds.push_back(terms.kind(name, name, 0, "I1", name));
    kinds.push_back(terms.kind(std::string("of_") + name, std::string("of_") + name, 0, "I1", name));
  }
  const Kinds two(kinds.begin(), kinds.begin() + 4);
  const auto pairs = searched(terms, two, {2});
  EXPECT_EQ(names_of(pairs).front(), (Names{"of_p", "of_q"}));
  const auto triples = searched(terms, kinds, {3});
  EXPECT_THAT(names_of(triples), Contains(Names{"of_p", "of_q", "r"}));
  EXPECT_THAT(names_of(triples), Not(Contains(Names{"of_p", "of_q", "of_r"})));
}

}  // namespace
}  // namespace tunica::discovery::search_exchange_test
