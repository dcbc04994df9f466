// SPDX-License-Identifier: Apache-2.0
// Which terms an energy may have on given data, and where their parameters may lie.
#include "discovery/kinds.hpp"

#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "discovery/output/parts.hpp"

namespace tunica::discovery {
namespace {

using ::testing::ElementsAre;

/// A strip along z, stretched to λ = 3: C = diag(1/λ, λ², 1/λ) in the order tt, zz, rr.
const States stretched{{1, 1, 1, 0, 0, 0}, {1. / 3, 9, 1. / 3, 0, 0, 0}};
constexpr double first = 9 + 2. / 3 - 3, second = 6 + 1. / 9 - 3, along = 9 - 1;

std::vector<Kind> all_kinds(bool has_directions = true) { return kinds_of(Request{}, stretched, has_directions); }

const Shape& shape_of(const std::vector<Kind>& kinds, const std::string& name) {
  for (const Kind& kind : kinds)
    if (kind.name == name) return kind.shapes.at(0);
  throw std::out_of_range(name);
}

TEST(DiscoveryKinds, HaveNamesOfTheirOwnAndPriorsThatAddUpToOne) {
  const auto kinds = all_kinds();
  std::set<std::string> names;
  double all = 0, usual = 0;
  for (const Kind& kind : kinds) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    all += std::exp(kind.log_prior);
    if (kind.name == "I1_linear") usual = kind.log_prior;
  }
  EXPECT_NEAR(all, 1, 1e-12);
  for (const Kind& kind : kinds) {
    const bool odd = kind.name == "I1_logarithm" || kind.name == "I2_inverse_langevin";
    EXPECT_NEAR(kind.log_prior, odd ? usual + std::log(0.2) : usual, 1e-12) << kind.name;
  }
}

TEST(DiscoveryKinds, OfFibresNeedDirectionsOrThatSomebodyAsks) {
  for (const Kind& kind : all_kinds(false)) EXPECT_TRUE(kind.isotropic()) << kind.name;
  Request request;
  request.invariants = {"fibre axial"};
  request.laws = {"quadratic", "linear"};
  const auto asked = kinds_of(request, stretched, false);
  ASSERT_EQ(asked.size(), 1u) << "fibres have no linear law";
  EXPECT_EQ(asked[0].name, "fibre_axial_quadratic");
  EXPECT_EQ(asked[0].amplitude(), "k");
  EXPECT_NEAR(asked[0].reach.high, along, 1e-12);
  EXPECT_NEAR(asked[0].log_prior, 0, 1e-12);
}

TEST(DiscoveryKinds, AreNoneWhereTheDataReachNothing) {
  EXPECT_TRUE(kinds_of(Request{}, {{1, 1, 1, 0, 0, 0}, {1 + 1e-5, 1 - 1e-5, 1, 0, 0, 0}}, true).empty());
}

TEST(DiscoveryKinds, BeginWithinTheirRanges) {
  for (const Kind& kind : all_kinds())
    for (const Shape& shape : kind.shapes) {
      EXPECT_LT(shape.low, shape.high) << kind.name;
      ASSERT_FALSE(shape.starts.empty()) << kind.name;
      EXPECT_TRUE(std::is_sorted(shape.starts.begin(), shape.starts.end())) << kind.name;
      EXPECT_GE(shape.starts.front(), shape.low) << kind.name;
      EXPECT_LE(shape.starts.back(), shape.high) << kind.name;
      EXPECT_GE(shape.starts.size(), shape.name == "m" ? 2u : 3u) << kind.name;
    }
}

/// Over the range X of the invariant a law goes from nearly a straight line to a steep wall, and is finite everywhere.
TEST(DiscoveryKinds, BendFromALineToAWallOverTheRangeOfTheData) {
  const auto kinds = all_kinds();
  const auto expect = [&](const std::string& name, double low, double high) {
    EXPECT_NEAR(shape_of(kinds, name).low, low, 1e-12 * std::abs(low)) << name;
    EXPECT_NEAR(shape_of(kinds, name).high, high, 1e-12 * std::abs(high)) << name;
  };
  expect("I1_exponential", 0.05 / first, 25 / first);
  expect("I2_exponential", 0.05 / second, 25 / second);
  expect("I1_gent", 1.002 * first, 50 * first);
  expect("I1_inverse_langevin", 1 + 1.002 * first / 3, 1 + 50 * first / 3);
  expect("fibre_axial_exponential_square", 1e-3, 25 / along / along);  // the least that `composed` takes
  expect("fibre_diagonal_quadratic", 15, 75);
  expect("I1_power", 2, 12);
}

/// Searches begin at a gentle bend, a clear one and a steep one over the same range.
TEST(DiscoveryKinds, BeginAtBendsThatTheDataCanTellApart) {
  const auto kinds = all_kinds();
  const auto expect = [&](const std::string& name, const std::vector<double>& starts) {
    const Shape& shape = shape_of(kinds, name);
    ASSERT_EQ(shape.starts.size(), starts.size()) << name;
    for (std::size_t k = 0; k < starts.size(); ++k)
      EXPECT_NEAR(shape.starts[k], starts[k], 1e-12 * starts[k]) << name << ", start " << k;
  };
  expect("I1_exponential", {0.5 / first, 2 / first, 6 / first});
  expect("I1_gent", {1.1 * first, 2 * first, 8 * first});
  expect("I1_inverse_langevin", {1 + 1.1 * first / 3, 1 + 2 * first / 3, 1 + 8 * first / 3});
  expect("I1_power", {2.5, 5});
  expect("fibre_axial_exponential_square", {0.5 / along / along, 3 / along / along, 9 / along / along});
  expect("fibre_diagonal_quadratic", {30, 45, 60});
}

/// λ^α up to e^15 at the largest stretch, and down to it where α is below 0.
TEST(DiscoveryKinds, HaveExponentsThatTheLargestStretchTellsApart) {
  const auto kinds = all_kinds();
  const double wide = 15 / std::log(3);
  EXPECT_NEAR(shape_of(kinds, "stretches_rising").high, wide, 1e-12);
  EXPECT_NEAR(shape_of(kinds, "stretches_rising").low, 0.2, 1e-12);
  EXPECT_NEAR(shape_of(kinds, "stretches_falling").low, -wide, 1e-12);
  EXPECT_NEAR(shape_of(kinds, "stretches_falling").high, -0.2, 1e-12);
  const States little{{1, 1, 1, 0, 0, 0}, {1 / 1.1, 1.21, 1 / 1.1, 0, 0, 0}};
  EXPECT_NEAR(shape_of(kinds_of(Request{}, little, true), "stretches_rising").high, 30, 1e-12) << "never more";
}

TEST(DiscoveryKinds, HaveCurvesWhoseKnotsAreDenserNearRest) {
  const auto kinds = all_kinds();
  const Kind isotropic = curve_of(kinds.front(), 4);
  EXPECT_EQ(isotropic.name, "I1_curve");
  ASSERT_EQ(isotropic.knots.size(), 5u);
  for (std::size_t j = 0; j < 5; ++j)
    EXPECT_NEAR(isotropic.knots[j], first * std::pow(static_cast<double>(j) / 4, 1.5), 1e-12);
  EXPECT_EQ(isotropic.amplitude(), "slope");
  EXPECT_THAT(isotropic.heights, ElementsAre("c_1", "c_2", "c_3", "c_4", "c_5"));
  EXPECT_EQ(isotropic.log_prior, kinds.front().log_prior);
  Request request;
  request.invariants = {"fibre diagonal"};
  const Kind fibres = curve_of(kinds_of(request, stretched, true).front(), 2);
  EXPECT_EQ(fibres.amplitude(), "c_1");
  EXPECT_THAT(fibres.heights, ElementsAre("c_2", "c_3"));
  ASSERT_EQ(fibres.shapes.size(), 1u);
  EXPECT_EQ(fibres.shapes[0].name, "theta");
}

TEST(DiscoveryWords, SayASmallProbabilityAsABound) {
  EXPECT_EQ(p_words(0.034), "p = 0.034");
  EXPECT_EQ(p_words(2e-4), "p = 0.0002");
  EXPECT_EQ(p_words(1.2e-4), "p = 0.00012");
  EXPECT_EQ(p_words(9e-5), "p < 0.0001");
}

}  // namespace
}  // namespace tunica::discovery
