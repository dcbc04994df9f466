// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/remedy.hpp"

#include <gmock/gmock.h>

#include "uncertainty/identifiability.hpp"
#include "uncertainty/local.hpp"
#include "uncertainty/strips.hpp"

using namespace tunica;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// kappa and theta act on both strips almost alike, and differently at 45 degrees, where they turn into shear.
TEST(Remedy, NamesTheSheetThatSeesWhatTheStripsDoNot) {
  const trial::Strips strips(0.3);
  std::vector<double> free = strips.truth;
  uncertainty::Identifiability found;
  ASSERT_TRUE(uncertainty::identify(*strips.assembly, free, found).ok());
  ASSERT_EQ(found.valleys.size(), 1u);
  EXPECT_THAT(found.valleys[0].sentence, HasSubstr("kappa"));
  EXPECT_THAT(
      found.valleys[0].sentence,
      HasSubstr("A sheet or strip cut at 45 deg to the axes, with its shear measured, to stretch 1.6 would show "
                "it best: relative to their largest value, its stresses change "));
}

TEST(Remedy, RecommendsNoTestThatSeesHardlyMoreThanThePresentOnes) {
  const trial::Strips strips(0.3);
  // All moduli by the same factor: every stress of every test grows by it, so that nothing sees it better.
  std::vector<double> step;
  for (std::size_t j = 0; j < strips.truth.size(); ++j) {
    const auto& name = strips.assembly->layout().parameters[j].name;
    step.push_back(name == "mu" || name == "k1" ? 0.1 * strips.truth[j] : 0);
  }
  EXPECT_THAT(uncertainty::remedy_in_words(*strips.assembly, strips.truth, {step}),
              StartsWith(" No in-plane test of a sheet to stretch 1.6 would see it 3 times as well. To fix "
                         "it, take the value of one of them from elsewhere"));
}

TEST(Remedy, IsAGeneralOneWhereNoStretchIsKnown) {
  const trial::Line line;
  EXPECT_THAT(uncertainty::remedy_in_words(line.assemble(), std::vector{1.0, 2.0}, {{1, 0}}),
              StartsWith(" To fix it, take "));
}
