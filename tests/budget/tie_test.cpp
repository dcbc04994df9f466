// SPDX-License-Identifier: Apache-2.0
// A tie between contenders that are made up.
#include "budget/tie.hpp"

#include <gmock/gmock.h>

#include "diagnosis/measured.hpp"

namespace tunica::budget {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

Contender in_test(const std::string& id, const std::string& test, Belief belief = Belief::plausible) {
  Contender one;
  one.id = one.sort = id;
  one.place.tests = {test};
  one.share = 0.9;
  one.belief = belief;
  return one;
}

/// An offset in either of two strips, and a gain that nobody would believe.
struct Tie : ::testing::Test {
  Tie() { budget.base.rms = 0.08; }
  Contender first = in_test("force_offset", "strip"), second = in_test("force_offset", "axial"),
            gain = in_test("force_scale_error", "strip", Belief::beyond);
  Ties ties = tied({&first, &second, &first, &gain});
  Budget budget;
};

TEST_F(Tie, IsBetweenPlacesOfOneMechanism) {
  EXPECT_THAT(ties, ElementsAre(&first, &second, &gain));
  EXPECT_THAT(tie_words(budget, ties),
              HasSubstr("force_offset in the test 'strip' 90 %, force_offset in the test 'axial' 90 %, "
                        "force_scale_error in the test 'strip' 90 % (beyond belief)"));
}

TEST_F(Tie, ClaimsTheSamePlacesAndDoubtsThatItPrints) {
  diagnosis::Claim claim;
  claim_tie(ties, {"viscoelasticity"}, claim);
  EXPECT_THAT(claim.ambiguity_set, ElementsAre("force_offset", "force_scale_error", "viscoelasticity"));
  EXPECT_THAT(claim.in_words, ElementsAre("force_offset in the test 'strip'", "force_offset in the test 'axial'",
                                          "force_scale_error in the test 'strip' (beyond belief)", "viscoelasticity"));
}

TEST_F(Tie, AsksForTestsOfWhatIsBelievedInAllItsPlaces) {
  const auto how = switches(ties, testing::catalogue());
  EXPECT_THAT(how, ElementsAre(StartsWith("force_offset in the test 'strip' or in the test 'axial': ")));
  first.belief = second.belief = Belief::beyond;
  EXPECT_THAT(switches(ties, testing::catalogue()), IsEmpty());
  EXPECT_EQ(isolated_by("I2 (linear)", testing::catalogue()), "");
}

TEST_F(Tie, TellsPowersOfTheStretchesApartByWhatTheyActLike) {
  Contender a = in_test("stretches (power)", ""), b;
  a.place = {};
  b = a;
  a.sort = "I1";
  b.sort = "I2";
  diagnosis::Claim claim;
  claim_tie(tied({&a, &b}), {}, claim);
  EXPECT_THAT(claim.in_words, ElementsAre("stretches (power), acting like I1", "stretches (power), acting like I2"));
  EXPECT_THAT(claim.ambiguity_set, ElementsAre("stretches (power)"));
}

}  // namespace
}  // namespace tunica::budget
