// SPDX-License-Identifier: Apache-2.0
// How a summary words causes and rivals: doubts in place of a probability that means nothing, material apart from rig.
#include <gmock/gmock.h>

#include "diagnosis/measured.hpp"
#include "diagnosis/output/outputs.hpp"

namespace tunica::trial {
namespace {

using diagnosis::Diagnosis;
using diagnosis::Verdict;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Standing, DoubtsAmplitudesOfCausesAndRivals) {
  Diagnosis found;
  found.explanation.verdict = Verdict::indistinguishable;
  found.explanation.claim.named = 1;
  found.explanation.claim.ambiguity_set = {"first", "second"};
  found.explanation.claim.causes = {diagnosis::Cause(), diagnosis::Cause()};
  found.explanation.claim.causes[0].id = "first";
  found.explanation.claim.causes[1].id = "second";
  found.explanation.claim.causes[0].amplitude = {"value", "kPa", 3, 2, 4, true};
  found.explanation.claim.causes[1].amplitude = {"value", "1", 9, 8, 10, false, false};
  const std::string words = in_one_line(diagnosis::summary(found).plain());
  EXPECT_THAT(words, HasSubstr("value = 3 kPa (2 … 4); likeliest of the catalogue, but at its bound"));
  EXPECT_THAT(words, HasSubstr("second (beyond what is plausible)"));
  EXPECT_THAT(words, Not(HasSubstr("probability")));
}

TEST(Standing, StatesNoProbabilityBesideARestThatIsNotNoise) {
  Diagnosis found;
  found.explanation.verdict = Verdict::unknown;
  found.explanation.claim.named = 1;
  found.explanation.claim.causes = {diagnosis::Cause()};
  diagnosis::Cause& cause = found.explanation.claim.causes.front();
  cause.id = "first";
  cause.probability = 1;
  cause.amplitude = {"value", "kPa", 3, 2, 4};
  found.explanation.p_after = 1e-9;
  EXPECT_THAT(
      in_one_line(diagnosis::summary(found).plain()),
      AllOf(HasSubstr("likeliest of the catalogue, but what is left is not noise"), Not(HasSubstr("probability"))));
  EXPECT_STREQ(code_of(standing_of(cause, found.explanation)), "rest_is_left");
  found.explanation.p_after = 0.5;
  EXPECT_THAT(in_one_line(diagnosis::summary(found).plain()), HasSubstr("probability 1.00"));
  cause.amplitude.plausible = false;
  EXPECT_THAT(in_one_line(diagnosis::summary(found).plain()), Not(HasSubstr("probability 1.00")));
}

TEST(Standing, ShowsRivalsInTheMaterialApartFromThoseInTheRig) {
  Diagnosis found;
  found.explanation.verdict = Verdict::indistinguishable;
  found.explanation.claim.named = 1;
  found.explanation.claim.causes.resize(4);
  const char* const ids[] = {"first", "in_rig", "in_material", "in_rig_too"};
  for (std::size_t k = 0; k < 4; ++k) {
    diagnosis::Cause& cause = found.explanation.claim.causes[k];
    cause.id = ids[k];
    cause.probability = 0.25;
    cause.group = k % 2 == 1 ? diagnosis::CauseGroup::rig : diagnosis::CauseGroup::material;
  }
  EXPECT_THAT(in_one_line(diagnosis::summary(found).plain()),
              HasSubstr("in the material: in_material (0.25); in the rig: in_rig (0.25), in_rig_too (0.25)"));
}

}  // namespace
}  // namespace tunica::trial
