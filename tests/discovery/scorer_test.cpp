// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gmock/gmock.h>

#include "execution/folder.hpp"
#include "scored_cases.hpp"
#include "scorer/table.hpp"

using namespace blind::score;
using namespace blind::score::trial;
using ::testing::HasSubstr;

// 5 of 100: Wilson 1927; figures as tabulated by Newcombe, Stat. Med. 17:857 (1998), method 3, for 81/263 and 0/20.
TEST(Scorer, GivesWilsonIntervals) {
  const Share newcombe{81, 263}, nothing{0, 20}, empty;
  EXPECT_NEAR(newcombe.low(), 0.2553, 5e-5);
  EXPECT_NEAR(newcombe.high(), 0.3662, 5e-5);
  EXPECT_NEAR(nothing.low(), 0, 1e-12);
  EXPECT_NEAR(nothing.high(), 0.1611, 5e-5);
  EXPECT_EQ(empty.low(), 0);
  EXPECT_EQ(empty.high(), 1);
}

TEST(Scorer, CountsFalseAlarmsByNoise) {
  const auto cases = together(
      {times(95, of_set("nulls", "white", "nothing_detected")), times(5, of_set("nulls", "relative", "unknown")),
       times(9, of_set("nulls", "ar1", "nothing_detected")), times(1, of_set("nulls", "ar1", "named"))});
  const Figure plain = figure(cases, "false alarms at α = 0.05");
  EXPECT_EQ(plain.cases, 100U);
  EXPECT_NEAR(plain.value, 0.05, 1e-12);
  EXPECT_FALSE(plain.missed());
  const Figure correlated = figure(cases, "false alarms, ρ = 0.3, covariance from replicates");
  EXPECT_NEAR(correlated.value, 0.1, 1e-12);
  EXPECT_TRUE(correlated.missed());
  EXPECT_FALSE(correlated.surely_missed());  // one of ten may be chance
  EXPECT_NEAR(figure(cases, "false alarms, noise relative").value, 1, 1e-12);
}

TEST(Scorer, TakesNamingOfGrossErrorsThatAreThereForNoAlarm) {
  Case contaminated = of_set("nulls", "outliers", "suspect_data");
  contaminated.truth.contaminated = true;
  contaminated.verdict.causes = {
      {.id = "outliers", .target = {}, .probability = {}, .amplitude = {}, .low = {}, .high = {}}};
  EXPECT_FALSE(judged(contaminated).detected());
  Case clean = contaminated;
  clean.truth.contaminated = false;
  EXPECT_TRUE(judged(clean).detected());
  contaminated.verdict.causes.push_back(contaminated.verdict.causes.front());
  contaminated.verdict.causes.back().id = "active_tone";
  EXPECT_TRUE(judged(contaminated).detected());
  EXPECT_EQ(judged(contaminated).causes.size(), 1U);
  // Two that are named together, the second of them the gross errors, and a rival: one is named.
  Cause rival = contaminated.verdict.causes.back();
  rival.id = "tethering";
  std::swap(contaminated.verdict.causes[0], contaminated.verdict.causes[1]);
  contaminated.verdict.causes.push_back(rival);
  contaminated.verdict.together = 2;
  EXPECT_EQ(judged(contaminated).together, 1U);
}

TEST(Scorer, CountsANameByItselfOrWithADeclaredLookAlikeThatTheDataCannotTellApart) {
  Case tied = single("b", 60, "indistinguishable", {"a", "b"});
  const LookAlikes declared{{"a", {"b"}}};
  EXPECT_FALSE(named_first(tied.verdict, "b"));
  EXPECT_TRUE(named_first(tied.verdict, "a"));
  EXPECT_FALSE(named_with_look_alike(tied.verdict, "b", declared)) << "no correlation on these data";
  tied.verdict.confusable[{"a", "b"}] = 0.89;
  EXPECT_FALSE(named_with_look_alike(tied.verdict, "b", declared));
  tied.verdict.confusable[{"a", "b"}] = 0.95;
  EXPECT_TRUE(named_with_look_alike(tied.verdict, "b", declared));
  EXPECT_FALSE(named_with_look_alike(tied.verdict, "b", {{"a", {"c"}}})) << "not declared";
  tied.verdict.ambiguity_set = {"a", "c"};
  EXPECT_FALSE(named_with_look_alike(tied.verdict, "b", declared)) << "not in the set";

  tied.verdict.ambiguity_set = {"a", "b"};
  const auto cases =
      together({times(3, single("a", 60, "named", {"a"})), times(1, tied),
                times(1, single("a", 60, "nothing_detected", {})), times(1, single("a", 60, "unknown", {}))});
  const Figure right = figure(cases, "right name first given detection, Λ 60", declared);
  EXPECT_EQ(right.cases, 5U) << "undetected cases are not asked";
  EXPECT_NEAR(right.value, 0.8, 1e-12);
  EXPECT_TRUE(oracle_named({true, "b", {}}, "b", {}));
  EXPECT_TRUE(oracle_named({true, "a", {{"b", 0.95}}}, "b", declared));
  EXPECT_FALSE(oracle_named({true, "a", {{"b", 0.95}}}, "b", {}));
  EXPECT_FALSE(oracle_named({true, "a", {}}, "b", declared));
  EXPECT_THAT(right.remark, HasSubstr("without look-alikes 0.600, \"unknown\" disregarded 0.600"));
}

TEST(Scorer, CallsAClaimWrongOnlyWhereItExcludesTheTruth) {
  const auto cases =
      together({times(7, single("a", 10, "named", {"a"})), times(1, single("a", 10, "indistinguishable", {"b", "a"})),
                times(1, single("a", 10, "named", {"b"})), times(1, single("a", 10, "unknown", {}))});
  EXPECT_NEAR(figure(cases, "wrong (truth excluded), Λ 10").value, 0.1, 1e-12);
  const Figure held = figure(cases, "ambiguity set holds the truth (Λ ≥ 10)");
  EXPECT_EQ(held.cases, 9U) << "unknown claims nothing";
  EXPECT_NEAR(held.value, 8. / 9, 1e-12);
  const auto sized = together(
      {times(1, single("a", 25, "named", {"a"})), times(1, single("a", 25, "indistinguishable", {"b", "a", "c"}))});
  EXPECT_NEAR(figure(sized, "mean size of the set at Λ 25").value, 2, 1e-12);
}

TEST(Scorer, LeavesOutEffectsThatNoPlausibleAmplitudeShowsButListsThem) {
  Case faint = single("a", 60, "nothing_detected", {});
  faint.truth.effects.front().reached = false;
  const auto cases =
      together({times(2, faint), times(1, single("a", 60, "named", {"a"})), times(1, single("a", 60, "named", {"b"}))});
  EXPECT_EQ(figure(cases, "right name first given detection, Λ 60").cases, 2U);
  const auto rows = effects(cases, {});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].unreached, 2U);
  EXPECT_EQ(rows[0].detected.total, 2U);
  EXPECT_EQ(rows[0].named.hits, 1U);
  ASSERT_EQ(rows[0].confused_with.size(), 1U);
  EXPECT_EQ(rows[0].confused_with[0], (std::pair<std::string, std::size_t>("b", 1)));
  EXPECT_THAT(markdown("# here", {figures(cases, {}), {}, {}, {}, rows}),
              HasSubstr("| `a` | 60 | 2 | 2 | 1.00 | 0.50 | 0.50 | 1.00 | b 1 |"));
}

TEST(Scorer, ComparesDetectionWithTheOracleOnTheSameCases) {
  auto cases = together({times(9, single("a", 25, "named", {"a"})), times(1, single("a", 25, "nothing_detected", {}))});
  EXPECT_EQ(figure(cases, "detected, as a share of the oracle's, Λ ≥ 25").cases, 0U) << "no oracle, no figure";
  for (Case& one : cases) one.oracle = Oracle{true, "a"};
  EXPECT_NEAR(figure(cases, "detected, as a share of the oracle's, Λ ≥ 25").value, 0.9, 1e-12);
  cases[0].oracle->detected = false;
  EXPECT_NEAR(figure(cases, "detected, as a share of the oracle's, Λ ≥ 25").value, 1, 1e-12);
}

TEST(Scorer, WantsEveryEffectNamedInHalfOfItsCases) {
  const auto row = [](double lambda, std::size_t named, std::size_t cases) {
    EffectRow one;
    one.id = "a";
    one.lambda = lambda;
    one.detected = {cases, cases};
    one.named_or_look_alike = {named, cases};
    return one;
  };
  EXPECT_TRUE(unnamed({row(60, 2, 3), row(60, 1, 2), row(60, 0, 0), row(25, 0, 3)}).empty());
  EXPECT_EQ(unnamed({row(60, 1, 3)}), std::vector<std::string>{"a is named in 1 of 3 cases at Λ 60"});
}

TEST(Scorer, WantsBothOfAPairAndNothingElse) {
  Case pair = of_set("pairs", "white", "named");
  pair.truth.asked = 60, pair.truth.effects = {{.id = "a", .target = {}}, {.id = "b", .target = {}}};
  const auto saying = [&](const std::vector<std::string>& ids) {
    Case one = pair;
    for (const auto& id : ids)
      one.verdict.causes.push_back({.id = id, .target = {}, .probability = {}, .amplitude = {}, .low = {}, .high = {}});
    return one;
  };
  const std::vector<Case> cases{saying({"b", "a"}), saying({"a"}), saying({"a", "b", "c"}), saying({"a", "c"})};
  EXPECT_NEAR(figure(cases, "two effects, exact pair, Λ 60 each").value, 0.25, 1e-12);
  EXPECT_NEAR(figure(cases, "two effects, false discoveries among the causes named").value, 2. / 8, 1e-12);
}

TEST(Scorer, CountsALookAlikeInAPairAndNoRivalOfIt) {
  Case pair = of_set("pairs", "white", "indistinguishable");
  pair.truth.asked = 60, pair.truth.effects = {{.id = "a", .target = {}}, {.id = "b", .target = {}}};
  for (const auto* id : {"a", "twin_of_b", "rival"})
    pair.verdict.causes.push_back({.id = id, .target = {}, .probability = {}, .amplitude = {}, .low = {}, .high = {}});
  pair.verdict.ambiguity_set = {"a", "twin_of_b", "b", "rival"};
  pair.verdict.confusable[{"b", "twin_of_b"}] = 0.95;
  pair.verdict.together = 2;
  const LookAlikes declared{{"twin_of_b", {"b"}}};
  const auto counted = [](const std::vector<Figure>& table, const std::string& name) {
    return std::find_if(table.begin(), table.end(), [&](const Figure& one) { return one.name == name; })->value;
  };
  const auto with = figures({pair}, declared), without = figures({pair}, {});
  EXPECT_EQ(counted(with, "two effects, exact pair, Λ 60 each"), 1);
  EXPECT_EQ(counted(with, "two effects, false discoveries among the causes named"), 0);
  EXPECT_EQ(counted(without, "two effects, exact pair, Λ 60 each"), 0);
  EXPECT_EQ(counted(without, "two effects, false discoveries among the causes named"), 0.5);
  pair.verdict.verdict = "unknown";
  EXPECT_EQ(counted(figures({pair}, declared), "two effects, exact pair, Λ 60 each"), 0);
}

TEST(Scorer, TellsPairsThatAreNamedFromThoseThatAreOneOfSeveral) {
  Case named = of_set("pairs", "white", "named");
  named.truth.asked = 60, named.truth.effects = {{.id = "a", .target = {}}, {.id = "b", .target = {}}};
  for (const auto* id : {"c", "a"})
    named.verdict.causes.push_back({.id = id, .target = {}, .probability = {}, .amplitude = {}, .low = {}, .high = {}});
  named.verdict.together = 2;
  Case open = named, silent = named;
  open.verdict.verdict = "indistinguishable", open.verdict.alternatives = {{"d", "e"}, {"b", "a"}};
  silent.verdict.verdict = "unknown";
  const std::vector<Case> cases{named, open, silent};
  const Figure wrong = figure(cases, "two effects, false discoveries where the verdict is \"named\"");
  EXPECT_EQ(wrong.cases, 2U);
  EXPECT_NEAR(wrong.value, 0.5, 1e-12);
  const Figure within = figure(cases, "two effects, the very pair is the first or an alternative");
  EXPECT_EQ(within.cases, 2U);
  EXPECT_NEAR(within.value, 0.5, 1e-12);
}

TEST(Scorer, SetsTheOraclesPairBesideThatOfTheVerdict) {
  Case pair = of_set("pairs", "white", "unknown");
  pair.truth.asked = 60, pair.truth.effects = {{.id = "a", .target = {}}, {.id = "b", .target = {}}};
  pair.oracle = Oracle{true, "a", {}, {{"twin_of_b", {{"b", 0.95}}}, {"a"}}};
  const auto remark = [&](const LookAlikes& declared) {
    return figure({pair}, "two effects, false discoveries among the causes named", declared).remark;
  };
  EXPECT_THAT(remark({{"twin_of_b", {"b"}}}), HasSubstr("oracle 0.000"));
  EXPECT_THAT(remark({}), HasSubstr("oracle 0.500"));
  pair.oracle->pair.clear();
  EXPECT_THAT(remark({}), ::testing::Not(HasSubstr("oracle")));
}

TEST(Scorer, WantsHonestyAboutWhatNoCatalogueLists) {
  Case far = single("friction", 60, "unknown", {});
  far.truth.set = "outside";
  far.truth.remainder = 40;
  Case set = far, name = far;
  set.verdict = single("", 0, "indistinguishable", {"a", "b"}).verdict;
  name.verdict = single("", 0, "named", {"a"}).verdict;
  EXPECT_NEAR(figure({far, set, name}, "outside the catalogue, remainder ≥ 25: unknown or a set").value, 2. / 3, 1e-12);
  // Two together, or what is not listed; and two together.
  Case open = set, closed = name;
  closed.verdict.ambiguity_set = open.verdict.ambiguity_set;
  for (Case* one : {&open, &closed}) {
    one->verdict.together = 2;
    one->verdict.causes.push_back(one->verdict.causes.front());
  }
  EXPECT_NEAR(figure({open, closed}, "outside the catalogue, remainder ≥ 25: unknown or a set").value, 0.5, 1e-12);

  const std::string near_row = "outside, remainder below: in a set with its look-alike, or \"consistent with\"";
  for (Case* one : {&far, &set, &name}) one->truth.remainder = 5, one->truth.look_alike = "b";
  EXPECT_NEAR(figure({far, set, name}, near_row).value, 2. / 3, 1e-12);
  set.truth.look_alike = "elsewhere";
  EXPECT_NEAR(figure({set, name}, near_row).value, 0, 1e-12);
  name.verdict.causes.front().hedged = true;
  EXPECT_NEAR(figure({set, name}, near_row).value, 0.5, 1e-12);
}

TEST(Scorer, MeasuresAmplitudesFromTheNullAndIntervals) {
  Case one = single("a", 25, "named", {"a"});
  one.truth.effects.front().amplitude = 1.5;
  one.truth.effects.front().null = 1;
  state_amplitude(one, 1.6, 1.4, 1.8);
  Case off = one;
  state_amplitude(off, 1.4, 1.3, 1.45);
  Case elsewhere = one;
  elsewhere.verdict.causes.front().target.test = "another";
  elsewhere.verdict.causes.front().amplitude = 100;
  const std::vector<Case> cases{one, off, elsewhere};
  EXPECT_EQ(figure(cases, "amplitude, relative rms at Λ 25").cases, 2U);
  EXPECT_NEAR(figure(cases, "amplitude, relative rms at Λ 25").value, 0.2, 1e-12);
  EXPECT_NEAR(figure(cases, "amplitude, coverage of the 95 % interval").value, 0.5, 1e-12);
  // χ² of 2 degrees of freedom: 0.0506 and 7.378 at 2.5 % and 97.5 %.
  EXPECT_NEAR(figure(cases, "amplitude, relative rms at Λ 25").low, 0.2 * std::sqrt(2 / 7.378), 1e-4);
  EXPECT_NEAR(figure(cases, "amplitude, relative rms at Λ 25").high, 0.2 * std::sqrt(2 / 0.0506), 1e-3);

  off.truth.effects.front().nuisance = true;
  EXPECT_EQ(figure({one, off}, "amplitude, relative rms at Λ 25").cases, 1U);
  EXPECT_NEAR(figure({one, off}, "amplitude, relative rms at Λ 25, effects with a nuisance parameter").value, 0.2,
              1e-12);

  Case even = single("m", 60, "named", {"m"});
  even.truth.effects.front().even = true;
  state_amplitude(even, -2.2, -2.5, -1.9);
  EXPECT_NEAR(figure({even}, "amplitude, relative rms at Λ 60").value, 0.1, 1e-12) << "its sign means nothing";
  EXPECT_NEAR(figure({even}, "amplitude, coverage of the 95 % interval").value, 1, 1e-12);
}

TEST(Scorer, HoldsStatedProbabilitiesAgainstWhatCameTrue) {
  std::vector<Case> cases =
      together({times(8, single("a", 60, "named", {"a"})), times(2, single("a", 60, "named", {"b"}))});
  for (Case& one : cases) one.verdict.causes.front().probability = 0.85;
  const Figure error = figure(cases, "expected calibration error of the stated probability");
  EXPECT_EQ(error.cases, 10U);
  EXPECT_NEAR(error.value, 0.05, 1e-12);
  EXPECT_LT(error.low, 0.01) << "ten cases cannot miss a bar by so little";
}

TEST(Scorer, CountsHeldOutBlocksOfTheRightNames) {
  Case right = single("a", 60, "named", {"a"}), wrong = single("a", 60, "named", {"b"});
  right.verdict.held_out = {0.3, 0.04, 0.9, 0.6};
  wrong.verdict.held_out = {0.001};
  const Figure blocks = figure({right, wrong}, "held-out predictive p-value above 0.05 with the named mechanism");
  EXPECT_EQ(blocks.cases, 4U);
  EXPECT_NEAR(blocks.value, 0.75, 1e-12);
}
