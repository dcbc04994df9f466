// SPDX-License-Identifier: Apache-2.0
// The budget of strips with a listed cause and a smooth unlisted misfit.
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "budget/budget.hpp"
#include "budget/output/outputs.hpp"
#include "diagnosis/measured.hpp"
#include "discovery/after_diagnosis.hpp"

namespace tunica::trial {
namespace {

using diagnosis::Verdict;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::SizeIs;

struct Answer {
  budget::Budget budget;
  diagnosis::Diagnosis diagnosis;
};

/// Two strips with a clock and cycles to rising stretches, of a wall that softens by `s`, and an unlisted smooth misfit
/// of so many kPa. Noise has σ = 0.3 kPa, a hundredth of the range. `change` what the budget says before its verdict.
Answer answered(double s, double unlisted, const std::vector<std::string>& groups = {"material", "rig", "file"},
                const std::function<void(budget::Budget&)>& change = {}) {
  std::vector<double> stretch, time;
  for (const double top : {1.25, 1.4, 1.5})
    for (int i = 0; i < 24; ++i) {
      const double share = i < 12 ? i / 12.0 : (24 - i) / 12.0;
      stretch.push_back(1 + (top - 1) * share + 0.001);
      time.push_back(static_cast<double>(time.size()));
    }
  Measured measured({{.stretch = stretch, .time = time}, {.name = "axial", .stretch = stretch, .time = time}});
  measured.measure(
      7,
      [s](nlohmann::json& truth) {
        if (s > 0) truth["models"]["gho"]["mechanisms"] = {mechanism("stress_softening", "s", s)};
      },
      [unlisted](const Strip&, double at) { return unlisted * std::sin(7 * (at - 1)); });
  measured.experiment["diagnosis"]["groups"] = groups;
  measured.save();
  Answer answer{{}, measured.diagnose()};
  const auto experiment = measured.read();
  answer.budget = budget::budget_of(answer.diagnosis, nullptr, experiment, testing::catalogue());
  if (change) change(answer.budget);
  answer.diagnosis =
      budget::with_verdict_of(answer.budget, experiment, testing::catalogue(), std::move(answer.diagnosis));
  return answer;
}

TEST(Budget, LeadsWithTheCauseThatTakesMostBesideAnUnlistedMisfit) {
  const Answer answer = answered(0.4, 1.2);
  EXPECT_EQ(answer.diagnosis.explanation.verdict, Verdict::leading);
  EXPECT_THAT(answer.diagnosis.explanation.reasons.front().text, HasSubstr("mainly stress_softening: it takes "));
  ASSERT_THAT(answer.budget.steps, SizeIs(Ge(1)));
  EXPECT_EQ(answer.budget.steps.front().id, "stress_softening");
  EXPECT_GT(answer.budget.steps.front().share, 0.6);
  EXPECT_LT(answer.budget.rest().rms, answer.budget.base.rms);
  ASSERT_TRUE(answer.diagnosis.explanation.claim.best);
}

std::string first_reason(const Answer& answer) { return answer.diagnosis.explanation.reasons.front().text; }

TEST(Budget, LooksOnlyInTheGroupsThatWereAskedForAndSaysWhatWasLeftOut) {
  const Answer answer = answered(0.4, 1.2, {"rig", "file"});
  for (const diagnosis::RankedMechanism& one : answer.diagnosis.explanation.ranking)
    EXPECT_EQ(one.group, diagnosis::CauseGroup::rig) << one.id;
  EXPECT_THAT(answer.diagnosis.explanation.ranking, SizeIs(Ge(1)));
  for (const budget::Contender& one : answer.budget.contenders)
    EXPECT_EQ(one.group, diagnosis::CauseGroup::rig) << one.id;
  EXPECT_THAT(in_one_line(budget::summary(answer.budget, "gho").plain()),
              HasSubstr("causes in the material, terms of the energy (left out by \"groups\")"));
}

TEST(Budget, SaysHowProbableAnUnlistedMisfitIsWhereItIsNotExcluded) {
  const Answer answer = answered(0.4, 1.2, {"material", "rig", "file"},
                                 [](budget::Budget& budget) { budget.unlisted_probability = 0.24; });
  ASSERT_EQ(answer.diagnosis.explanation.verdict, Verdict::leading);
  EXPECT_THAT(first_reason(answer),
              HasSubstr("; that it is a smooth misfit without a listed cause has probability 0.24"));
}

TEST(Budget, TakesTheProbabilityOfACauseFromItsPlace) {
  const Answer answer = answered(0.4, 1.2, {"material", "rig", "file"}, [](budget::Budget& budget) {
    budget::Contender elsewhere = budget.contenders.front();
    elsewhere.place.tests = {"axial"};
    elsewhere.share = 0.1;
    elsewhere.probability = 2;  // made up, so that it would show
    budget.contenders.push_back(elsewhere);
  });
  ASSERT_THAT(answer.diagnosis.explanation.claim.causes, SizeIs(Ge(1)));
  EXPECT_EQ(answer.diagnosis.explanation.claim.causes.front().id, answer.budget.contenders.front().id);
  EXPECT_LE(answer.diagnosis.explanation.claim.causes.front().probability, 1);
}

TEST(Budget, LeadsAfterACheaperMethodOnlyWithWhatTakesHalfWithTheTestsThemselves) {
  const auto with = [](std::optional<double> share) {
    return answered(0.4, 1.2, {"material", "rig", "file"}, [share](budget::Budget& budget) {
      budget.cheaper = budget::Budget::Cheaper{{"plate"}, share};
    });
  };
  const Answer most = with(0.91), less = with(0.49), failed = with(std::nullopt);
  EXPECT_EQ(most.diagnosis.explanation.verdict, Verdict::leading);
  EXPECT_THAT(first_reason(most), HasSubstr("; causes were weighed with a cheaper method of plate, and fitted together "
                                            "with the own one they take 91 %"));
  EXPECT_EQ(less.diagnosis.explanation.verdict, Verdict::unknown);
  EXPECT_THAT(first_reason(less), HasSubstr("they take 49 %"));
  EXPECT_FALSE(less.budget.lead);
  EXPECT_EQ(failed.diagnosis.explanation.verdict, Verdict::unknown);
  EXPECT_THAT(first_reason(failed), HasSubstr("a cheaper method of plate, and were not fitted with the own one"));
}

TEST(Budget, LeadsWithNothingWhereOnlyAnUnlistedMisfitIsThere) {
  const Answer answer = answered(0, 1.2);
  EXPECT_NE(answer.diagnosis.explanation.verdict, Verdict::leading);
  EXPECT_NE(answer.diagnosis.explanation.verdict, Verdict::named);
}

TEST(Budget, HasTheCausesOfTheVerdictWhereTheyLeaveNoise) {
  const Answer answer = answered(0.4, 0);
  EXPECT_EQ(answer.diagnosis.explanation.verdict, Verdict::named);
  ASSERT_THAT(answer.budget.steps, SizeIs(1));
  EXPECT_EQ(answer.budget.steps.front().id, "stress_softening");
  EXPECT_GT(answer.budget.steps.front().share, 0.95);
  EXPECT_DOUBLE_EQ(answer.budget.steps.front().share, answer.budget.steps.front().shapley);
  EXPECT_TRUE(answer.budget.adequate);
  EXPECT_THAT(answer.budget.contenders, SizeIs(0));
}

}  // namespace
}  // namespace tunica::trial
