// SPDX-License-Identifier: Apache-2.0
// What to do after a verdict, by budgets that are made up.
#include "budget/next_step.hpp"

#include <gmock/gmock.h>

namespace tunica::budget {
namespace {

using diagnosis::ReasonKind;
using diagnosis::Verdict;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Lack = Budget::Lack;

struct NextStep : ::testing::Test {
  NextStep() {
    budget.base = {0.08, 0.09};
    budget.tolerance.share = 0.02;
  }
  [[nodiscard]] std::string after(Verdict verdict, ReasonKind reason = ReasonKind::unlisted_misfit) const {
    diagnosis::Explanation explanation;
    explanation.verdict = verdict;
    explanation.reasons = {{reason, ""}};
    return next_step(budget, explanation);
  }
  Budget budget;
};

TEST_F(NextStep, IsAskedOfTheFileFirst) {
  budget.not_looked_for = {{"viscoelasticity", Lack::clock}};
  EXPECT_EQ(after(Verdict::leading), "Map a time column: then viscoelasticity can be tried.");
  budget.not_looked_for = {{"permanent_set", Lack::order}, {"stress_softening", Lack::order}};
  EXPECT_EQ(after(Verdict::indistinguishable),
            "Say in which order the rows were measured (\"order\"): then permanent_set and stress_softening can be "
            "tried.");
  budget.not_looked_for = {{"viscoelasticity", Lack::clock}, {"stress_softening", Lack::order}};
  EXPECT_THAT(after(Verdict::unknown),
              StartsWith("Say in which order the rows were measured (\"order\"): then stress_softening can be tried. "
                         "Map a time column: then viscoelasticity can be tried as well. Measure a test again"));
  budget.not_looked_for = {{"stress_softening", Lack::loading}};
  EXPECT_THAT(after(Verdict::leading), StartsWith("Record the loading before the first row too"));
  budget.not_looked_for = {{"clamped_ends", Lack::size}};
  EXPECT_EQ(after(Verdict::leading), "Say how long and how wide the specimen is: then clamped_ends can be tried.");
}

TEST_F(NextStep, BeginsWithTheNoiseWhereAnEstimateLetsTheFitFollowOneChannel) {
  budget.lopsided = "axial_force to 0.04 % of its range and outer_diameter to 1.0 %";
  budget.not_looked_for = {{"viscoelasticity", Lack::clock}};
  EXPECT_EQ(after(Verdict::leading),
            "State the noise: it is estimated, axial_force to 0.04 % of its range and outer_diameter to 1.0 %, so that "
            "the fit follows the one and lets the other go. Map a time column: then viscoelasticity can be tried.");
}

TEST_F(NextStep, OfAnUnlistedMisfitDependsOnWhatIsLeft) {
  EXPECT_THAT(after(Verdict::unknown), EndsWith("asks for another base model."));
  budget.base = {0.01, 0.03};
  EXPECT_THAT(after(Verdict::unknown), EndsWith("asks for another base model."));
  budget.base = {0.01, 0.015};
  EXPECT_THAT(after(Verdict::unknown), HasSubstr("good enough for this tolerance"));
  budget.rough = true;
  EXPECT_THAT(after(Verdict::unknown), HasSubstr("twice on one specimen"));
}

TEST_F(NextStep, IsNotAskedForWhereNothingIsOpen) {
  EXPECT_EQ(after(Verdict::leading), "");
  EXPECT_EQ(after(Verdict::unknown, ReasonKind::lost_stability), "");
  budget.not_looked_for = {{"viscoelasticity", Lack::clock}};
  for (const Verdict verdict : {Verdict::nothing_detected, Verdict::named, Verdict::suspect_data, Verdict::discovered})
    EXPECT_EQ(after(verdict), "");
}

}  // namespace
}  // namespace tunica::budget
