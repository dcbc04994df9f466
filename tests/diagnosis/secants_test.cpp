// SPDX-License-Identifier: Apache-2.0
// A mechanism whose effect has another shape at a finite amplitude is looked for there too.
#include <gmock/gmock.h>

#include "diagnosis/search_bed.hpp"

namespace tunica::diagnosis::secants_test {
namespace {

using ::testing::SizeIs;
using Side = MechanismFactory::Side;

/// At x = 1 the amplitude, at x = 2 so many times its square; nothing elsewhere.
Effect bending(double k) {
  return [k](double x, auto own, const Options&) { return x == 1 ? own[0] : x == 2 ? k * own[0] * own[0] : 0.0; };
}

std::vector<Hypothesis> found_of(MechanismFactory factory, const Projection& projection = {}) {
  SearchBed bed;
  bed.add("a", {1, 2, 3});
  const std::string id = factory.id;
  bed.put(std::move(factory));
  bed.close();
  return bed.find(id, projection).hypotheses;
}

void expect_signature(const Hypothesis& found, const Eigen::Vector3d& expected) {
  ASSERT_EQ(found.signature.size(), 3);
  EXPECT_LT((found.signature - expected).norm(), 1e-7) << found.signature.transpose();
}

// σ = 0.5. Half of what is plausible: v = 0.5 upwards, and −1 downwards.
TEST(Secants, AreTakenAtHalfAPlausibleAmplitudeOnEitherSide) {
  MechanismFactory factory = acting("bending", bending(4));
  factory.plausible_min = -2;
  const auto found = found_of(factory);
  ASSERT_THAT(found, SizeIs(3));
  expect_signature(found[0], {2, 4, 0});
  EXPECT_EQ(found[0].sign, 1);
  expect_signature(found[1], {-2, 8, 0});
  EXPECT_EQ(found[1].sign, -1);
  for (const std::size_t k : {0u, 1u}) {
    EXPECT_TRUE(found[k].at_large);
    EXPECT_EQ(found[k].side, Side::positive) << "the other side has its own";
  }
  expect_signature(found[2], {2, 0, 0});
  EXPECT_FALSE(found[2].at_large);
  EXPECT_EQ(found[2].side, Side::both);
}

// From 0.5 it is 0.5 up to what is plausible, and 1.5 down.
TEST(Secants, AreTakenFromTheNull) {
  MechanismFactory factory = acting("bending", [bend = bending(4)](double x, auto own, const Options& options) {
    const double from_null = own[0] - 0.5;
    return bend(x, std::span(&from_null, 1), options);
  });
  factory.null = 0.5;
  const auto found = found_of(factory);
  ASSERT_THAT(found, SizeIs(3));
  expect_signature(found[0], {2, 2, 0});
  expect_signature(found[1], {-2, 6, 0});
}

TEST(Secants, AreNoneOnASideThatIsNotPlausible) {
  MechanismFactory factory = acting("bending", bending(4));
  factory.plausible_min = 0;
  auto found = found_of(factory);
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(found[0].sign, 1);
  factory.plausible_min = -0.8;
  factory.plausible_max = 0;
  found = found_of(factory);
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(found[0].sign, -1);
  expect_signature(found[0], {-2, 3.2, 0});
  // One-sided, though the other side is plausible as well.
  factory = acting("bending", bending(4));
  factory.side = Side::positive;
  found = found_of(factory);
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(found[0].sign, 1);
  expect_signature(found[0], {2, 4, 0});
}

// The cosine between (1, 0) and (1, k/2) is 0.97 at k = 0.501.
TEST(Secants, AreWorthALookWhereTheirShapeIsAnother) {
  EXPECT_THAT(found_of(acting("bending", bending(0.48))), SizeIs(1));
  EXPECT_THAT(found_of(acting("bending", bending(0.52))), SizeIs(3));
  EXPECT_THAT(found_of(acting("bending", bending(0))), SizeIs(1));
  const Projection absorbing{Eigen::MatrixXd(Eigen::Vector3d(0, 1, 0))};
  EXPECT_THAT(found_of(acting("bending", bending(4)), absorbing), SizeIs(1)) << "what a refit absorbs is no shape";
}

// What fails at half of what is plausible is looked at at a fifth; what fails there too has none.
TEST(Secants, AreNearerWhereNothingCanBeEvaluatedFarOut) {
  const auto failing_from = [](double limit) {
    return acting("failing", [limit, bend = bending(4)](double x, auto own, const Options& options) {
      return std::abs(own[0]) > limit ? 1e7 : bend(x, own, options);
    });
  };
  const auto found = found_of(failing_from(0.3));
  ASSERT_THAT(found, SizeIs(3));
  expect_signature(found[0], {2, 1.6, 0});
  expect_signature(found[1], {-2, 1.6, 0});
  EXPECT_THAT(found_of(failing_from(0.1)), SizeIs(1));
}

TEST(Secants, AreNoneOfAnEvenEffectNorOfAChannel) {
  MechanismFactory even = acting("even", [](double x, auto own, const Options&) {
    const double v = own[0] * own[0];
    return x == 1 ? v : x == 2 ? 4 * v * v : 0.0;
  });
  even.side = Side::even;
  EXPECT_THAT(found_of(even), SizeIs(1));
  MechanismFactory channel = acting("channel", bending(4));
  channel.options = {Option::text("channel", "y", "")};
  EXPECT_THAT(found_of(channel), SizeIs(1)) << "its unit is not the mechanism's to know";
}

}  // namespace
}  // namespace tunica::diagnosis::secants_test
