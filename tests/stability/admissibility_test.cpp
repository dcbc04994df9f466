// SPDX-License-Identifier: Apache-2.0
#include "stability/admissibility.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mechanisms/shelf.hpp"
#include "stability/sheared.hpp"

namespace tunica {
namespace {

using stability::Path;
using ::testing::HasSubstr;

const std::vector<double> set_s{18.668, 0.1367, 24.905, 0.2912, 46.44};
const std::vector<double> set_u{10.015, 5.1799e-3, 20.315, 0.17086, 45.83};

const stability::Domain rubber{.strips = {}, .largest = 3, .beyond = 5};

stability::Domain strips_to(double last) {
  stability::Domain domain{.strips = {}, .largest = last};
  for (auto& strip : domain.strips)
    for (int k = 1; k <= 40; ++k) strip.push_back(1 + (last - 1) * k / 40);
  return domain;
}

double energy(const Model& model, const std::vector<double>& p, const std::array<double, 6>& C) {
  double W = 0;
  const Status status = model.evaluate({1, C, p, {}, {}}, {{&W, 1}, {}, {}, {}, {}});
  return status.ok() ? W : std::nan("");
}

// m·Q(n) m is the second derivative of W along F' = m⊗n F.
TEST(Ellipticity, WeakestValueIsTheCurvatureOfTheEnergyInItsShear) {
  const auto gho = testing::model("gho");
  for (const std::array<double, 3> stretch : {std::array<double, 3>{1.4, 0.9, 1 / 1.26}, {0.8, 1.5, 1 / 1.2}}) {
    const auto verdict = stability::judge_ellipticity(*gho, set_s, {Path{"one", {{stretch, 1.4}}}});
    const auto at = [&](double epsilon) {
      return energy(*gho, set_s, stability::sheared(stretch, verdict.m, verdict.n, epsilon));
    };
    const double h = 1e-4;
    EXPECT_NEAR((at(h) - 2 * at(0) + at(-h)) / (h * h), verdict.weakest, 1e-5 * verdict.weakest);
    // No other shear is weaker.
    for (int k = 0; k < 200; ++k) {
      const double a = 0.7 * k, b = 1.3 * k;
      const std::array<double, 3> n{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
      const std::array<double, 3> m{std::cos(a) * std::cos(b), std::cos(a) * std::sin(b), -std::sin(a)};
      const auto here = [&](double epsilon) { return energy(*gho, set_s, stability::sheared(stretch, m, n, epsilon)); };
      EXPECT_GT((here(h) - 2 * here(0) + here(-h)) / (h * h), 0.999 * verdict.weakest);
    }
  }
}

// Fibres that carry compression (fibre_switch none) lose ellipticity: Merodio & Ogden, Int. J. Solids Struct. 39:3323
// (2002), for W = μ/2 (I1 − 3) + k1/2 (I4 − 1)², pressed along the fibres in plane strain.
TEST(Ellipticity, IsLostWhereFibresArePressed) {
  const auto hgo = testing::model("hgo", "none");
  Path pressed{"pressed", {}};
  for (double x = 0.99; x > 0.5; x -= 0.01) pressed.points.push_back({{x, 1 / x, 1}, x});
  // Both families along t: angle 90 deg from z.
  const auto verdict = stability::judge_ellipticity(*hgo, std::vector<double>{1, 5, 1e-6, 90}, {pressed});
  ASSERT_TRUE(verdict.first_lost);
  // W = μ/2 (I1 − 3) + k1 (I4 − 1)² here, two families: n = (cos a, sin a): m·Qm = μ (x² n1² + n2²/x²) +
  // 4 k1 x² n1² (I4 − 1) + 8 k1 x⁴ n1² m1² with m1² = n2²; its least value changes sign at the stretch found below.
  const auto weakest = [](double x) {
    double least = 1e300;
    for (double a = 0; a < 3.15; a += 1e-3) {
      const double n1 = std::pow(std::cos(a), 2), n2 = 1 - n1, x2 = x * x;
      least = std::min(least, x2 * n1 + n2 / x2 + 4 * 5 * x2 * n1 * (x2 - 1) + 8 * 5 * x2 * x2 * n1 * n2);
    }
    return least;
  };
  double edge = 1;
  while (weakest(edge) > 0) edge -= 1e-4;
  EXPECT_NEAR(*verdict.first_lost, edge, 0.0101);
}

TEST(Drucker, HoldsForNeoHookeAndIsLostWithANegativeSecondModulus) {
  const auto neo_hooke = testing::model("neo_hooke");
  const auto good = stability::judge_admissibility(*neo_hooke, std::vector<double>{100}, rubber);
  ASSERT_TRUE(good.drucker);
  EXPECT_FALSE(good.drucker->first_lost);
  EXPECT_FALSE(good.ellipticity.first_lost);
  const auto rivlin = testing::model("mooney_rivlin");
  const auto bad = stability::judge_admissibility(*rivlin, std::vector<double>{60, -10}, rubber);
  ASSERT_TRUE(bad.drucker && bad.drucker->first_lost);
  // In equibiaxial extension dσ/dλ of W = c10 (I1 − 3) + c01 (I2 − 3) is 0 where c10 (λ + 2 λ⁻⁵) + c01 (2 λ³ + λ⁻³) is,
  // that is where λ d(σ)/dλ, σ = 2 (λ² − λ⁻⁴)(c10 + c01 λ²), vanishes: it bounds the loss from above.
  double stretch = 1;
  const auto stress = [](double x) { return 2 * (x * x - std::pow(x, -4)) * (60 - 10 * x * x); };
  while (stress(stretch + 1e-4) > stress(stretch)) stretch += 1e-4;
  EXPECT_LE(*bad.drucker->first_lost, stretch + 0.1);
  EXPECT_GT(*bad.drucker->first_lost, 1.05);
}

TEST(Drucker, IsOnlyAskedOfIsotropicModels) {
  EXPECT_FALSE(stability::is_isotropic(*testing::model("gho"), set_s));
  EXPECT_TRUE(stability::is_isotropic(*testing::model("gho"), std::vector<double>{18, 1. / 3, 25, 0.3, 30}));
  EXPECT_TRUE(stability::is_isotropic(*testing::model("neo_hooke"), std::vector<double>{100}));
}

TEST(Admissibility, SaysWhatIsLostAndWhere) {
  const auto gho = testing::model("gho");
  const auto unstable = stability::judge_admissibility(*gho, set_u, strips_to(1.8));
  EXPECT_EQ(unstable.transversely_stable(), false);
  EXPECT_THAT(unstable.sentences().front(), HasSubstr("circumferential strip: UNSTABLE"));
  EXPECT_THAT(unstable.sentences().front(), HasSubstr("from stretch 1.166"));
  const auto stable = stability::judge_admissibility(*gho, set_s, strips_to(1.8));
  EXPECT_EQ(stable.transversely_stable(), true);
  EXPECT_THAT(stable.sentences().front(), HasSubstr("falls up to stretch"));
  // Measured only where it is still stable: said, and no verdict of instability.
  const auto short_of_it = stability::judge_admissibility(*gho, set_u, strips_to(1.1));
  EXPECT_EQ(short_of_it.transversely_stable(), true);
  EXPECT_THAT(short_of_it.sentences().front(),
              HasSubstr("stable (measured to 1.1); beyond that domain the transverse stretch"));
}

TEST(Admissibility, IsNotCertifiedWhereNothingWasMeasured) {
  const auto gho = testing::model("gho");
  stability::Domain none = strips_to(1.8);
  none.strips = {};
  const auto unasked = stability::judge_admissibility(*gho, set_u, none);
  EXPECT_EQ(unasked.transversely_stable(), std::nullopt);
  EXPECT_THAT(unasked.sentences().front(), HasSubstr("(no strip was measured)"));
  // A constraint's range is asked for.
  none.asked[0] = {1.1, 1.3};
  const auto asked = stability::judge_admissibility(*gho, set_u, none);
  EXPECT_EQ(asked.transversely_stable(), false);
  EXPECT_THAT(asked.sentences().front(), HasSubstr("UNSTABLE, the transverse stretch λ3 grows from stretch 1.166"));
  EXPECT_THAT(asked.sentences().front(), HasSubstr("(judged to 1.3)"));
}

// I1 = λ² + 2/λ < 3 + Jm ends a strip at 2.33 and equibiaxial extension at 1.7.
TEST(Admissibility, IsReportedAsFarAsTheResponseCanBeFollowed) {
  const auto gent = testing::model("gent");
  stability::Domain far{.strips = {}, .largest = 1000};
  const auto nowhere = stability::judge_admissibility(*gent, std::vector<double>{10, 0.2}, far);
  EXPECT_EQ(nowhere.ellipticity.followed.size(), 5u);
  for (const auto& path : nowhere.ellipticity.followed) EXPECT_EQ(path.to, 1) << path.path;
  EXPECT_THAT(nowhere.sentences(),
              ::testing::Contains("ellipticity NOT ASSESSED: the response cannot be evaluated on any path"));
  EXPECT_THAT(nowhere.sentences(),
              ::testing::Contains("Drucker's condition NOT ASSESSED: the response cannot be evaluated on any path"));
  far.largest = 3;
  const auto some = stability::judge_admissibility(*gent, std::vector<double>{10, 3}, far);
  EXPECT_FALSE(some.ellipticity.first_lost);
  for (const auto& path : some.ellipticity.followed) {
    const bool equibiaxial = path.path == "equibiaxial extension";
    EXPECT_GT(path.to, equibiaxial ? 1.5 : 2) << path.path;
    EXPECT_LT(path.to, equibiaxial ? 1.74 : 2.5) << path.path;
  }
  EXPECT_THAT(some.sentences()[2],
              HasSubstr("elliptic as far as the response can be followed: circumferential strip to 2."));
  EXPECT_THAT(some.sentences()[3], HasSubstr("Drucker-stable as far as the response can be followed"));
}

}  // namespace
}  // namespace tunica
