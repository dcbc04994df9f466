// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "diagnosis/measured.hpp"

namespace tunica::trial {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// Noise of 0.3 kPa; the first row of a strip has some 1 kPa, of which 1 % is 30 times less.
TEST(VanishingNoise, OfRowsNearZeroIsToldOfWhereTheyCarryTheMisfit) {
  Measured measured;
  measured.measure(51);
  const auto with = [&](const nlohmann::json& noise) {
    for (const Strip& strip : measured.strips) measured.experiment["tests"][strip.name]["data"]["noise"] = noise;
    return warning_texts(measured.diagnose());
  };
  EXPECT_THAT(with({{"relative", 0.01}}),
              Contains(AllOf(HasSubstr("purely relative noise makes rows near zero almost exact: "),
                             HasSubstr("circumferential, stress ("), HasSubstr("State noise.absolute too"))));
  EXPECT_THAT(with({{"absolute", 0.3}, {"relative", 0.01}}), Not(Contains(HasSubstr("purely relative"))));
}

// Noise of 0.005 kPa, half of what is stated of the first row and far less than of the last: rows near zero have most
// of |r|², and all of it is noise.
TEST(VanishingNoise, IsNotToldOfWhereItIsAsSmallAsStated) {
  Measured measured({Strip{.sd = 0.005}, Strip{.name = "axial", .sd = 0.005}});
  measured.measure(51);
  for (const Strip& strip : measured.strips)
    measured.experiment["tests"][strip.name]["data"]["noise"] = {{"relative", 0.01}};
  EXPECT_THAT(warning_texts(measured.diagnose()), Not(Contains(HasSubstr("purely relative"))));
}

}  // namespace
}  // namespace tunica::trial
