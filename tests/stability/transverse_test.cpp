// SPDX-License-Identifier: Apache-2.0
#include "stability/transverse.hpp"

#include <cmath>
#include <numbers>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <gtest/gtest.h>

#include "mechanisms/shelf.hpp"

namespace tunica::transverse_test {
namespace {

using stability::FreePath;
using stability::judge_transverse;

// Canales et al. 2023, Table 6: with (S) and without (U) stabilisation. Order mu, kappa, k1, k2, theta.
const std::vector<double> set_s{18.668, 0.1367, 24.905, 0.2912, 46.44};
const std::vector<double> set_u{10.015, 5.1799e-3, 20.315, 0.17086, 45.83};

std::vector<double> to(double last) {
  std::vector<double> stretches;
  for (int k = 1; k <= 40; ++k) stretches.push_back(1 + (last - 1) * k / 40);
  return stretches;
}

/// A strip of gho material (kappa = 0: hgo) by bisection in extended precision: λ3 on the free path, independent of
/// everything under test. The angle is from the loading axis, in degrees.
long double normal_stretch(long double mu, long double kappa, long double k1, long double k2, long double angle,
                           long double stretch) {
  const long double c = std::cos(angle * std::numbers::pi_v<long double> / 180), along = c * c, c1 = stretch * stretch;
  const auto lateral = [&](long double u) {
    const long double c3 = 1 / (c1 * u);
    const long double E = kappa * (c1 + u + c3) + (1 - 3 * kappa) * (along * c1 + (1 - along) * u) - 1;
    const long double f = E > 0 ? 2 * k1 * E * std::exp(k2 * E * E) : 0;
    return u * (mu / 2 + f * (kappa + (1 - 3 * kappa) * (1 - along))) - c3 * (mu / 2 + f * kappa);
  };
  long double low = 1e-6L, high = 100;
  for (int k = 0; k < 120; ++k) {
    const long double middle = std::sqrt(low * high);
    (lateral(middle) > 0 ? high : low) = middle;
  }
  return 1 / (stretch * std::sqrt(low));
}

TEST(TransverseStability, FlagsSetUWithItsFirstUnstableStretch) {
  const auto gho = testing::model("gho");
  const auto circumferential = judge_transverse(*gho, set_u, 0, to(1.8), 10),
             axial = judge_transverse(*gho, set_u, 1, to(1.8), 10);
  EXPECT_EQ(circumferential.stable, false);
  ASSERT_TRUE(circumferential.first_unstable);
  EXPECT_NEAR(*circumferential.first_unstable, 1.166, 1e-3);
  EXPECT_EQ(axial.stable, false);
  ASSERT_TRUE(axial.first_unstable && axial.stable_again);
  EXPECT_NEAR(*axial.first_unstable, 1.20, 5e-3);
  EXPECT_NEAR(*axial.stable_again, 3.44, 5e-3);
}

TEST(TransverseStability, FindsSetSStable) {
  const auto gho = testing::model("gho");
  for (const std::size_t axis : {0, 1}) {
    const auto verdict = judge_transverse(*gho, set_s, axis, to(1.8), 10);
    EXPECT_EQ(verdict.stable, true);
    EXPECT_FALSE(verdict.first_unstable) << *verdict.first_unstable;
    EXPECT_GT(verdict.checked_to, 3);
    EXPECT_LT(verdict.worst_slope, 0);
  }
}

TEST(TransverseStability, IsJudgedUnderCompressionTooWhereThatWasMeasured) {
  const auto hgo = testing::model("hgo", "none");  // fibres that carry compression
  const std::vector<double> p{10, 40, 1e-6, 30};
  std::vector<double> pressed;
  for (int k = 1; k <= 30; ++k) pressed.push_back(1 - 0.01 * k);
  const auto verdict = judge_transverse(*hgo, p, 1, pressed, 10);
  EXPECT_EQ(verdict.judged_from, pressed.back());
  EXPECT_EQ(verdict.judged_to, 1);
  EXPECT_NEAR(verdict.checked_from, 0.7, 1e-12);
  // As the path itself says.
  std::vector<stability::StripState> states(pressed.size());
  ASSERT_TRUE(FreePath(*hgo, 1, pressed).states(p, states).ok());
  bool falls = false;
  for (std::size_t k = 1; k < states.size(); ++k) falls = falls || states[k].normal < states[k - 1].normal;
  ASSERT_TRUE(falls);
  EXPECT_EQ(verdict.stable, false);
  ASSERT_TRUE(verdict.first_unstable_pressed);
  const auto rubber = judge_transverse(*testing::model("neo_hooke"), std::vector<double>{10}, 1, pressed, 10);
  EXPECT_EQ(rubber.stable, true);
  EXPECT_FALSE(rubber.first_unstable_pressed);
}

// Ψ = 1 by symmetry. The state is a minimum of the energy where W'(I1) > 0, outside of two roots.
TEST(TransverseStability, OfAnIsotropicMaterialIsLostWhereTheSymmetricStateIsNoMinimum) {
  const auto yeoh = testing::model("yeoh");
  const std::vector<double> p{106, -4.65, 0.0332}, stretch{2, 3.9, 5, 9, 9.2, 18};
  std::vector<double> slope(6, 7), slope_dp(18, 7);
  ASSERT_TRUE(FreePath(*yeoh, 0, stretch).slopes(p, slope, slope_dp).ok());
  for (const std::size_t i : {0u, 1u, 4u, 5u}) EXPECT_EQ(slope[i], 0) << stretch[i];
  for (const std::size_t i : {2u, 3u}) EXPECT_GT(slope[i], 1) << stretch[i];
  for (const double value : slope_dp) EXPECT_EQ(value, 0);
  const auto verdict = judge_transverse(*yeoh, p, 0, stretch, 18);
  EXPECT_EQ(verdict.stable, false);
  const auto excess = [](double l) { return l * l + 2 / l - 3; };
  const double root = std::sqrt(4.65 * 4.65 - 3 * 0.0332 * 106);
  ASSERT_TRUE(verdict.first_unstable && verdict.stable_again);
  EXPECT_NEAR(excess(*verdict.first_unstable), (4.65 - root) / (3 * 0.0332), 1e-6);
  EXPECT_NEAR(excess(*verdict.stable_again), (4.65 + root) / (3 * 0.0332), 1e-6);
}

TEST(TransverseStability, IsNoVerdictWhereNothingIsAskedOrTheResponseEnds) {
  const auto gent = testing::model("gent");
  const std::vector<double> p{10, 3};  // I1 < 6: a strip ends at stretch 2.3
  EXPECT_EQ(judge_transverse(*gent, p, 0, {}, 10).stable, std::nullopt);
  EXPECT_EQ(judge_transverse(*gent, p, 0, {1.5, 2}, 10).stable, true);
  const auto beyond = judge_transverse(*gent, p, 0, {1.5, 2, 5}, 10);
  EXPECT_EQ(beyond.stable, std::nullopt);
  EXPECT_LT(beyond.checked_to, 2.5);
}

// physics: Ψ → 1 + (1 − 3κ) sin²θ/κ, θ from the loading axis, once k2 E² ≫ 1.
TEST(TransverseStability, AnisotropyReachesItsLimitAtLargeStretch) {
  const auto gho = testing::model("gho");
  for (const double kappa : {0.05, 0.1367, 0.25})
    for (const double theta : {20.0, 46.44, 70.0}) {
      const std::vector<double> p{18.668, kappa, 24.905, 0.5, theta};
      for (const std::size_t axis : {0, 1}) {
        const double from_loading = (axis == 1 ? theta : 90 - theta) * std::numbers::pi / 180;
        const double limit = 1 + (1 - 3 * kappa) * std::pow(std::sin(from_loading), 2) / kappa;
        double stretch = 2, anisotropy = 0;
        // As far out as the exponential goes.
        for (; stretch < 100; stretch *= 1.1) {
          stability::StripState state;
          if (!FreePath(*gho, axis, {stretch}).states(p, {&state, 1}).ok()) break;
          anisotropy = state.anisotropy;
        }
        EXPECT_NEAR(anisotropy / limit, 1, 1e-3) << "kappa " << kappa << ", theta " << theta << ", to " << stretch;
      }
    }
}

TEST(TransverseStability, HgoLosesItForEveryObliqueAngle) {
  const auto hgo = testing::model("hgo");
  const auto steepest = judge_transverse(*hgo, std::vector<double>{10, 10, 1, 89}, 1, {}, 100);
  ASSERT_TRUE(steepest.first_unstable);
  EXPECT_NEAR(*steepest.first_unstable, 57, 1.5);
}

// Whatever the moduli: the fibres turn towards the pull, and the exponential makes them stiff in the end. Seed
// 20230211; μ and k1 from 0.1 to 1000 kPa, k2 from 0.05 to 20, all by logarithm, angles from 5 to 80 deg from the pull.
// A false alarm is impossible but for a defect: in this range the response overflows only beyond the loss.
TEST(TransverseStability, HgoLosesItAtRandomParameters) {
  const auto hgo = testing::model("hgo");
  boost::random::mt19937_64 engine(20230211);
  const auto uniform = [&](double low, double high) {
    return boost::random::uniform_real_distribution<double>(low, high)(engine);
  };
  for (int k = 0; k < 300; ++k) {
    const std::vector<double> p{std::exp(uniform(std::log(0.1), std::log(1000))),
                                std::exp(uniform(std::log(0.1), std::log(1000))),
                                std::exp(uniform(std::log(0.05), std::log(20))), uniform(5, 80)};
    const auto verdict = judge_transverse(*hgo, p, 1, {}, 1000);
    EXPECT_TRUE(verdict.first_unstable) << p[0] << " " << p[1] << " " << p[2] << " " << p[3] << ", checked to "
                                        << verdict.checked_to;
  }
}

TEST(TransverseStability, HgoKeepsItWithFibresAlongOrAcrossThePull) {
  const auto hgo = testing::model("hgo");
  for (const double angle : {0.0, 90.0})
    for (const std::size_t axis : {0, 1}) {
      const auto verdict = judge_transverse(*hgo, std::vector<double>{10, 10, 1, angle}, axis, {}, 50);
      EXPECT_FALSE(verdict.first_unstable) << angle << " at " << verdict.first_unstable.value_or(0);
      EXPECT_GT(verdict.checked_to, 3);
    }
}

TEST(TransverseStability, AlmostLinearFibresLoseItOnlyWhenStiffEnough) {
  const auto hgo = testing::model("hgo");
  // k2 → 0: unstable only if 4 k1 sin²θ/μ > 1, θ from the loading axis.
  const double theta = 40, s2 = std::pow(std::sin(theta * std::numbers::pi / 180), 2);
  for (const double ratio : {0.9, 1.1}) {
    const double mu = 10, k1 = ratio * mu / (4 * s2);
    const auto verdict = judge_transverse(*hgo, std::vector<double>{mu, k1, 1e-12, theta}, 1, {}, 20);
    EXPECT_EQ(verdict.first_unstable.has_value(), ratio > 1) << ratio;
  }
}

// Seed 20230211. The sign is compared where |d ln λ3/d ln λ1| is above the error of the differences, so that a false
// alarm is impossible but for a defect.
TEST(TransverseStability, HasTheSignOfTheTrueDerivativeAtRandomPoints) {
  const auto gho = testing::model("gho");
  boost::random::mt19937_64 engine(20230211);
  const auto uniform = [&](double low, double high) {
    return boost::random::uniform_real_distribution<double>(low, high)(engine);
  };
  int compared = 0, unstable = 0;
  for (int k = 0; k < 10000; ++k) {
    const std::vector<double> p{std::exp(uniform(0, 4.6)), uniform(0, 1. / 3), std::exp(uniform(-2, 4.6)),
                                std::exp(uniform(-4, 2)), uniform(0, 90)};
    const double stretch = uniform(1.01, 2);
    const auto axis = static_cast<std::size_t>(k % 2);
    double slope;
    ASSERT_TRUE(FreePath(*gho, axis, {stretch}).slopes(p, {&slope, 1}, {}).ok());
    const double from_loading = axis == 1 ? p[4] : 90 - p[4];
    const long double h = 1e-6L;
    const auto at = [&](long double x) { return normal_stretch(p[0], p[1], p[2], p[3], from_loading, x); };
    const auto truth =
        static_cast<double>((std::log(at(stretch * (1 + h))) - std::log(at(stretch * (1 - h)))) / (2 * h));
    if (std::abs(truth) < 1e-5) continue;
    ++compared;
    unstable += truth > 0;
    EXPECT_EQ(slope - 1 > 0, truth > 0) << "stretch " << stretch << ", slope " << slope << ", true " << truth;
    EXPECT_NEAR((slope - 1) / 2, truth, 1e-4) << "a family may switch within the difference";
  }
  EXPECT_GT(compared, 9900);
  EXPECT_GT(unstable, 500);
  EXPECT_LT(unstable, 9500);
}

TEST(TransverseStability, DerivativesAgreeWithDifferences) {
  const auto gho = testing::model("gho");
  const std::vector<double> stretches{1, 1.05, 1.2, 1.4, 1.6, 1.8};
  for (const auto& set : {set_s, set_u})
    for (const std::size_t axis : {0, 1}) {
      const FreePath path(*gho, axis, stretches);
      const std::size_t n = stretches.size();
      std::vector<double> slope(n), slope_dp(5 * n), above(n), below(n);
      ASSERT_TRUE(path.slopes(set, slope, slope_dp).ok());
      for (std::size_t j = 0; j < 5; ++j) {
        std::vector<double> moved = set;
        const double h = 1e-5 * set[j];
        moved[j] = set[j] + h;
        ASSERT_TRUE(path.slopes(moved, above, {}).ok());
        moved[j] = set[j] - h;
        ASSERT_TRUE(path.slopes(moved, below, {}).ok());
        double scale = 0;
        for (std::size_t i = 0; i < n; ++i) scale = std::max(scale, std::abs(slope_dp[j * n + i]));
        for (std::size_t i = 0; i < n; ++i)
          EXPECT_NEAR(slope_dp[j * n + i], (above[i] - below[i]) / (2 * h), 1e-6 * scale) << j << ", " << stretches[i];
      }
    }
}

TEST(TransverseStability, IsThatOfTheEquilibriumResponseForAModelWithMemory) {
  const auto bare = testing::model("gho");
  const auto viscous = testing::wrapped("viscoelasticity", testing::model("gho"));
  std::vector<double> p = set_u;
  for (std::size_t j = p.size(); j < viscous->describe().parameters.size(); ++j)
    p.push_back(viscous->describe().parameters[j].max * 0.5);
  const std::vector<double> stretches{1.1, 1.3, 1.7};
  std::vector<double> expected(3), found(3);
  ASSERT_TRUE(FreePath(*bare, 0, stretches).slopes(set_u, expected, {}).ok());
  ASSERT_TRUE(FreePath(*viscous, 0, stretches).slopes(p, found, {}).ok());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1e-9);
}

TEST(TransverseStability, FailsWithAReasonWhereTheEnergyOverflows) {
  const auto gho = testing::model("gho");
  double slope;
  const Status status = FreePath(*gho, 0, {30}).slopes(std::vector<double>{10, 0.2, 10, 50, 45}, {&slope, 1}, {});
  EXPECT_EQ(status.kind(), Status::Kind::failed);
  EXPECT_NE(status.reason().find("circumferential strip at stretch 30"), std::string::npos) << status.reason();
}

}  // namespace
}  // namespace tunica::transverse_test
