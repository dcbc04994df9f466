// SPDX-License-Identifier: Apache-2.0
// Tables of the classes beside the plain one, of mistakes and of time.
#include <gmock/gmock.h>

#include "scored_cases.hpp"
#include "scorer/table.hpp"

using namespace blind::score;
using namespace blind::score::trial;
using ::testing::HasSubstr;

namespace {

Figure class_figure(const std::vector<Case>& cases, const std::string& name) {
  for (const Figure& one : class_figures(cases, {}))
    if (one.name == name) return one;
  throw std::runtime_error("no figure " + name);
}

}  // namespace

TEST(Scorer, KeepsOtherClassesOutOfTheMainTable) {
  Case rubber = of_set("nulls", "white", "named");
  rubber.truth.base = "yeoh";
  rubber.truth.protocol = "rubber";
  const auto cases = together({times(19, of_set("nulls", "white", "nothing_detected")), times(1, rubber)});
  EXPECT_EQ(figure(cases, "false alarms at α = 0.05").cases, 19U);
  const Figure own = class_figure(cases, "yeoh × rubber: false alarms");
  EXPECT_EQ(own.cases, 1U);
  EXPECT_FALSE(own.missed()) << "one case says nothing of its class";
  EXPECT_TRUE(class_figure(together({cases, times(49, rubber)}), own.name).missed());
  EXPECT_TRUE(class_figure(cases, "these classes together: false alarms").missed());
  Case found = single("a", 60, "named", {"a"});
  found.truth.base = "gho";
  found.oracle = Oracle{true, "b", {}, {}};
  Case not_found = found;
  not_found.verdict = single("a", 60, "named", {"c"}).verdict;
  const Figure right = class_figure(together({times(39, found), times(13, not_found)}),
                                    "gho × artery: right name first given detection, Λ 60");
  EXPECT_NEAR(right.value, 0.75, 1e-12);
  EXPECT_TRUE(right.missed());
  EXPECT_EQ(right.remark, "oracle 0.000");
}

// Of ten pairs two are right only with the noise stated, one only without: −0.1; Bonett and Price 2012 with n = 10:
// p = 2/12, q = 3/12, −1/12 ± 1.96 √((5/12 − 1/144)/12).
TEST(Scorer, ComparesCasesWithTheSameDataWhoseNoiseIsStated) {
  std::vector<Case> cases;
  const auto add = [&cases](const char* without, const char* with) {
    Case stated = single("a", 25, "named", {with}), silent = single("a", 25, "named", {without});
    stated.name = "stated-" + std::to_string(cases.size());
    stated.oracle = Oracle{true, "a", {}, {}};
    silent.name = "silent-" + std::to_string(cases.size());
    silent.truth.noise_stated = false;
    silent.truth.twin = stated.name;
    cases.insert(cases.end(), {stated, silent});
  };
  for (int k = 0; k < 6; ++k) add("a", "a");
  add("b", "b");
  add("a", "b");
  add("b", "a");
  add("c", "a");
  const Figure paired = class_figure(cases, "noise not stated: right name less that of the same data with it, Λ 25");
  EXPECT_EQ(paired.cases, 10U);
  EXPECT_NEAR(paired.value, -0.1, 1e-12);
  EXPECT_NEAR(paired.low, -0.44550, 2e-5);
  EXPECT_NEAR(paired.high, 0.27883, 2e-5);
  EXPECT_TRUE(paired.missed());
  EXPECT_FALSE(paired.surely_missed());
  const Figure detected =
      class_figure(cases, "noise not stated: detected, as a share of the stated-noise oracle's, Λ ≥ 25");
  EXPECT_NEAR(detected.value, 1, 1e-12);
  EXPECT_EQ(class_of(cases[1].truth), "hgo × artery, noise not stated");
  EXPECT_EQ(figure(cases, "right name first given detection, Λ 25").cases, 10U) << "the stated ones";
}

TEST(Scorer, AllowsNoMemoryWhereTheOrderIsNotRecorded) {
  Case one = single("stress_softening", 60, "named", {"stress_softening"});
  one.truth.order_recorded = false;
  one.truth.effects.front().id = "active_tone";
  const std::string name = "hgo × artery, order not recorded: a mechanism with memory among the causes named";
  EXPECT_TRUE(class_figure({one}, name).missed());
  one.verdict.causes.front().id = "active_tone";
  EXPECT_FALSE(class_figure({one}, name).missed());
}

TEST(Scorer, PutsEveryCaseInOneColumnOfMistakes) {
  Case several = single("a", 60, "named", {"a"});
  several.verdict.causes.push_back(several.verdict.causes.front());
  several.verdict.causes.back().id = "b";
  Case first_of_oracle = single("a", 60, "named", {"a"});
  first_of_oracle.oracle = Oracle{true, "a", {}, {}};
  const auto rows = mistakes(together({{first_of_oracle, several},
                                       times(2, single("a", 60, "named", {"c"})),
                                       times(3, single("a", 60, "unknown", {})),
                                       times(4, single("a", 60, "nothing_detected", {}))}),
                             {});
  ASSERT_EQ(rows.size(), 1U);
  const MistakeRow& row = rows.front();
  EXPECT_EQ(row.name, "hgo × artery");
  EXPECT_EQ(row.cases, 11U);
  EXPECT_EQ(row.right, 1U);
  EXPECT_EQ(row.over_named, 1U);
  EXPECT_EQ(row.wrong, 2U);
  EXPECT_EQ(row.unknown, 3U);
  EXPECT_EQ(row.missed, 4U);
  EXPECT_EQ(row.oracle_cases, 1U);
  EXPECT_EQ(row.oracle_right, 1U);
  EXPECT_THAT(markdown("", {{}, {}, {}, rows, {}}),
              HasSubstr("| hgo × artery | 60 | 11 | 1 | 2 | 1 | 3 | 4 | 1 | 0 | 0 |"));
}

TEST(Scorer, NamesTheSlowestCase) {
  Case quick = single("a", 60, "named", {"a"}), slow = single("b", 25, "named", {"b"});
  quick.seconds = 0.2;
  slow.seconds = 4;
  slow.name = "case-7";
  const auto table = time_figures({quick, slow, quick});
  EXPECT_NEAR(table.at(0).value, 0.2, 1e-12);
  EXPECT_FALSE(table.at(0).missed());
  EXPECT_NEAR(table.at(1).value, 4, 1e-12);
  EXPECT_TRUE(table.at(1).missed());
  EXPECT_THAT(table.at(1).remark, HasSubstr("case-7: singles b, Λ 25"));
  EXPECT_TRUE(time_figures({single("a", 60, "named", {"a"})}).empty());
}
