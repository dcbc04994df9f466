// SPDX-License-Identifier: Apache-2.0
// What to do after a verdict, by budgets that are made up.
#include "budget/next_step.hpp"

#include <gmock/gmock.h>

namespace tunica::budget {
namespace {

using diagnosis::Verdict;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct NextStep : ::testing::Test {
  NextStep() {
    budget.base.rms = 0.08;
    budget.tolerance.share = 0.02;
  }
  Budget budget;
};

TEST_F(NextStep, IsAskedOfTheFileFirst) {
  budget.not_looked_for = {{"viscoelasticity", true}};
  EXPECT_EQ(next_step(budget, Verdict::leading), "Map a time column: then viscoelasticity can be tried.");
  budget.not_looked_for = {{"permanent_set", false}, {"stress_softening", false}};
  EXPECT_EQ(next_step(budget, Verdict::indistinguishable),
            "Say in which order the rows were measured (\"order\"): then permanent_set and stress_softening can be "
            "tried.");
  budget.not_looked_for = {{"viscoelasticity", true}, {"stress_softening", false}};
  EXPECT_THAT(next_step(budget, Verdict::unknown),
              StartsWith("Say in which order the rows were measured (\"order\"), or map a time column: then "
                         "viscoelasticity and stress_softening can be tried. Measure a test again"));
}

TEST_F(NextStep, OfAnUnknownCauseDependsOnWhatIsLeft) {
  EXPECT_THAT(next_step(budget, Verdict::unknown), EndsWith("asks for another base model."));
  budget.base.rms = 0.01;
  EXPECT_THAT(next_step(budget, Verdict::unknown), HasSubstr("good enough for this tolerance"));
  budget.rough = true;
  EXPECT_THAT(next_step(budget, Verdict::unknown), HasSubstr("twice on one specimen"));
}

TEST_F(NextStep, IsNotAskedForWhereNothingIsOpen) {
  EXPECT_EQ(next_step(budget, Verdict::leading), "");
  budget.not_looked_for = {{"viscoelasticity", true}};
  for (const Verdict verdict : {Verdict::nothing_detected, Verdict::named, Verdict::suspect_data, Verdict::discovered})
    EXPECT_EQ(next_step(budget, verdict), "");
}

}  // namespace
}  // namespace tunica::budget
