// SPDX-License-Identifier: Apache-2.0
// hgo on the strips of a lamb aorta (examples/lamb_aorta_cause), which it describes, and loses stability on the way.
#include <gmock/gmock.h>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/output/outputs.hpp"
#include "support/loaded.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::HasSubstr;

Diagnosis lamb_aorta(bool admissibility, const data::Noise& noise = {2, 0.03, 0}) {
  auto experiment = experiment::read_experiment(
      std::filesystem::path(TUNICA_SOURCE_DIR) / "examples/lamb_aorta_cause/experiment.json", testing::catalogue());
  // As a rule so much that the curves alone are far from an alarm.
  for (auto& test : experiment.tests) test.data.noise = {{"stress", noise}};
  Request request = request_of(experiment);
  EXPECT_TRUE(request.admissibility);
  request.quick = true;
  request.admissibility = admissibility;
  return diagnose(experiment, request, testing::catalogue());
}

TEST(Admissibility, LostStabilityIsACauseWhereItIsAskedFor) {
  const Diagnosis found = lamb_aorta(true);
  EXPECT_EQ(found.explanation.admissibility.stable, false);
  EXPECT_THAT(found.explanation.admissibility.where, HasSubstr("transverse stability of the "));
  EXPECT_GT(found.analysis.alarm.detection.p, 0.05) << "the curves alone raise no alarm";
  ASSERT_EQ(found.explanation.verdict, Verdict::named);
  EXPECT_EQ(found.explanation.admissibility.remedy, "fibre_dispersion");
  EXPECT_EQ(found.explanation.claim.causes[0].id, "fibre_dispersion");
  EXPECT_THAT(found.explanation.reasons.front().text, HasSubstr("the base fit loses transverse stability"));
  ASSERT_TRUE(found.explanation.claim.best);
  EXPECT_GT(found.explanation.p_after, 0.01) << "what the extension leaves is noise";
  EXPECT_LE(found.prospects.gain->after, found.prospects.gain->before + 6);
  EXPECT_THAT(summary(found).plain(), HasSubstr("fibre_dispersion restores it"));
}

TEST(Admissibility, WhatMendsItIsNotTheWholeCauseWhereTheCurvesAreStillWrong) {
  const Diagnosis found = lamb_aorta(true, {0.2, 0.005, 0});
  EXPECT_LT(found.analysis.alarm.detection.p, 0.01);
  EXPECT_EQ(found.explanation.verdict, Verdict::unknown);
  EXPECT_EQ(found.explanation.admissibility.remedy, "fibre_dispersion");
  EXPECT_THAT(found.explanation.reasons.back().text, HasSubstr("noise would have to be "));
  EXPECT_LT(found.explanation.p_after, 0.01);
}

TEST(Admissibility, IsReportedAndChangesNothingWhereItIsNot) {
  const Diagnosis found = lamb_aorta(false);
  EXPECT_EQ(found.explanation.admissibility.stable, false);
  EXPECT_FALSE(found.explanation.admissibility.sentences.empty());
  EXPECT_EQ(found.explanation.admissibility.remedy, "");
  EXPECT_EQ(found.explanation.verdict, Verdict::nothing_detected);
  EXPECT_FALSE(found.explanation.claim.best);
  EXPECT_THAT(summary(found).plain(), HasSubstr("the base fit loses transverse stability"));
}

}  // namespace
}  // namespace tunica::diagnosis
