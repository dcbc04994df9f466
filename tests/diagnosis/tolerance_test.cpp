// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/tolerance.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/hand_made.hpp"
#include "tunica/error.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::DoubleNear;
using Kind = diagnosis::NoiseSource::Kind;

/// A curve of four rows with a range of 8 kPa.
struct OneCurve : diagnosis::HandMade {
  explicit OneCurve(Kind kind = Kind::stated) {
    add("s", {0, 1, 2, 3}, {1, 3, 5, 9}, {0.4, 0, 0}, kind);
    close();
  }
  [[nodiscard]] Tolerance with(std::vector<std::pair<std::string, std::string>> stated) const {
    diagnosis::Request request;
    request.tolerance = std::move(stated);
    return tolerance_of(request, evidence);
  }
};

TEST(Tolerance, IsTwoPerCentOfTheRangeUnlessSomethingSaysMore) {
  EXPECT_EQ(OneCurve().with({}).share, 0.02);
  EXPECT_EQ(code_of(OneCurve().with({}).origin), "default");
  const Tolerance repeats = OneCurve(Kind::replicates).with({});
  EXPECT_THAT(repeats.share, DoubleNear(0.05, 1e-12)) << "0.4 of 8 kPa";
  EXPECT_EQ(code_of(repeats.origin), "repeats");
}

TEST(Tolerance, IsWhatIsStatedAsAShareOrInTheUnit) {
  const OneCurve bed(Kind::replicates);
  EXPECT_THAT(bed.with({{"", "3 %"}}).share, DoubleNear(0.03, 1e-12));
  EXPECT_EQ(code_of(bed.with({{"", "3 %"}}).origin), "stated");
  EXPECT_THAT(bed.with({{"y", "800 Pa"}}).share, DoubleNear(0.1, 1e-12));
  EXPECT_THAT(bed.with({{"", "3 %"}, {"y", "4 %"}}).share, DoubleNear(0.04, 1e-12)) << "its own comes first";
  EXPECT_THAT(bed.with({{"z", "4 %"}}).share, DoubleNear(0.05, 1e-12)) << "of another observable";
  EXPECT_THROW((void)bed.with({{"y", "2 mm"}}), InputError);
}

}  // namespace
}  // namespace tunica::diagnosis
