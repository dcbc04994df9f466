// SPDX-License-Identifier: Apache-2.0
// hgo on the strips of a lamb aorta (examples/lamb_aorta_cause), which it describes, and loses stability on the way.
#include <gmock/gmock.h>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/outputs.hpp"
#include "support/loaded.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::HasSubstr;

Diagnosis lamb_aorta(bool admissibility, const data::Noise& noise = {2, 0.03, 0}) {
  auto experiment = experiment::read_experiment(
      std::filesystem::path(TUNICA_SOURCE_DIR) / "examples/lamb_aorta_cause/experiment.json", testing::catalogue());
  // As a rule so much that the curves alone are far from an alarm.
  for (auto& test : experiment.tests) test.data.noise = {{"stress", noise}};
  Settings settings = settings_of(experiment);
  EXPECT_TRUE(settings.admissibility);
  settings.quick = true, settings.admissibility = admissibility;
  return diagnose(experiment, settings, testing::catalogue());
}

TEST(Admissibility, LostStabilityIsACauseWhereItIsAskedFor) {
  const Diagnosis found = lamb_aorta(true);
  EXPECT_EQ(found.admissibility.stable, false);
  EXPECT_THAT(found.admissibility.where, HasSubstr("transverse stability of the "));
  EXPECT_GT(found.detection.p, 0.05) << "the curves alone raise no alarm";
  ASSERT_EQ(found.verdict, Verdict::named);
  EXPECT_EQ(found.admissibility.remedy, "fibre_dispersion");
  EXPECT_EQ(found.causes[0].id, "fibre_dispersion");
  EXPECT_THAT(found.reasons.front(), HasSubstr("the base fit loses transverse stability"));
  ASSERT_TRUE(found.extension);
  EXPECT_GT(found.p_after, 0.01) << "what the extension leaves is noise";
  EXPECT_LE(found.gain->after, found.gain->before + 6);
  EXPECT_THAT(summary(found), HasSubstr("fibre_dispersion mends it"));
}

TEST(Admissibility, WhatMendsItIsNotTheWholeCauseWhereTheCurvesAreStillWrong) {
  const Diagnosis found = lamb_aorta(true, {0.2, 0.005, 0});
  EXPECT_LT(found.detection.p, 0.01);
  EXPECT_EQ(found.verdict, Verdict::unknown);
  EXPECT_EQ(found.admissibility.remedy, "fibre_dispersion");
  EXPECT_THAT(found.reasons.back(), HasSubstr("with noise "));
  EXPECT_LT(found.p_after, 0.01);
}

TEST(Admissibility, IsReportedAndChangesNothingWhereItIsNot) {
  const Diagnosis found = lamb_aorta(false);
  EXPECT_EQ(found.admissibility.stable, false);
  EXPECT_FALSE(found.admissibility.sentences.empty());
  EXPECT_EQ(found.admissibility.remedy, "");
  EXPECT_EQ(found.verdict, Verdict::nothing_detected);
  EXPECT_FALSE(found.extension);
  EXPECT_THAT(summary(found), HasSubstr("the base fit loses transverse stability"));
}

}  // namespace
}  // namespace tunica::diagnosis
