// SPDX-License-Identifier: Apache-2.0
// Stability of materials that change their volume: published ranges, closed forms, and the curvature of the energy.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/guarded.hpp"
#include "stability/admissibility.hpp"
#include "stability/sheared.hpp"
#include "support/loaded.hpp"

namespace tunica::stability::compressible_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

std::unique_ptr<Model> compressible(std::unique_ptr<Model> base, const std::string& invariants,
                                    const std::string& law) {
  Options options;
  options.set("invariants", invariants);
  options.set("law", law);
  return plugins::wrap(testing::catalogue().mechanisms().at("compressibility"), std::move(base), options);
}

Admissibility judged(const Model& model, const std::vector<double>& p, double largest, double least = 1) {
  Domain domain;
  domain.largest = largest;
  if (least < 1) domain.strips[1] = {least};
  return judge_admissibility(model, p, domain);
}

double energy(const Model& model, const std::vector<double>& p, const std::array<double, 6>& C) {
  double W = 0;
  EXPECT_TRUE(model.evaluate({1, C, p, {}, {}}, {{&W, 1}, {}, {}, {}, {}}).ok());
  return W;
}

// m·Q(n) m is the second derivative of W along F' = m⊗n F, for any m. No other pair of directions has less.
TEST(CompressibleStability, TheWeakestWaveIsTheCurvatureOfTheEnergy) {
  const auto model = compressible(testing::make_model("gho"), "full", "logarithmic");
  const std::vector<double> p{20, 0.1, 30, 1.2, 40, 0.02};
  for (const std::array<double, 3> stretch : {std::array<double, 3>{1.3, 0.9, 0.8}, {0.8, 1.2, 1.1}}) {
    EllipticityVerdict verdict;
    const Deformation at{stretch, 1.3};
    set_weakest_wave(*model, p, at, verdict);
    const auto least = least_wave_stiffness(*model, p, stretch);
    ASSERT_TRUE(least);
    const double h = 1e-4;
    const auto curvature = [&](const std::array<double, 3>& m, const std::array<double, 3>& n) {
      const auto W = [&](double epsilon) { return energy(*model, p, sheared(stretch, m, n, epsilon)); };
      return (W(h) - 2 * W(0) + W(-h)) / (h * h);
    };
    EXPECT_NEAR(curvature(verdict.m, verdict.n), *least, 1e-5 * *least);
    for (int k = 0; k < 300; ++k) {
      const double a = 0.7 * k, b = 1.3 * k, c = 2.1 * k, d = 0.37 * k;
      const std::array<double, 3> n{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
      const std::array<double, 3> m{std::sin(c) * std::cos(d), std::sin(c) * std::sin(d), std::cos(c)};
      EXPECT_GT(curvature(m, n), (1 - 1e-5) * *least);
    }
  }
}

// Knowles, Sternberg, J. Elasticity 5:341 (1975): the foam of Blatz and Ko (f = 0, ν = 1/4) is elliptic where
// 2 − √3 < λ_i/λ_j < 2 + √3 for all pairs. In a strip λ2 = λ^(−1/4), in a sheet λ3 = λ^(−2/3), in a chamber the ratio
// is the stretch itself. A change of volume alone never loses it.
TEST(CompressibleStability, BlatzAndKosFoamLosesEllipticityWhereItIsPublished) {
  const double edge = 2 + std::sqrt(3);
  const auto foam = testing::make_model("blatz_ko");
  const std::vector<double> p{11, 0, 0.25};
  const Admissibility found = judged(*foam, p, 4, 0.2);
  ASSERT_TRUE(found.ellipticity.first_lost && found.changes_volume());
  const auto reach = [&](const std::string& path) {
    for (const PathReach& one : found.ellipticity.followed)
      if (one.path == path) return one.to;
    return std::nan("");
  };
  EXPECT_NEAR(reach("axial strip"), std::pow(edge, 0.8), 1e-6);
  EXPECT_NEAR(reach("circumferential strip"), std::pow(edge, 0.8), 1e-6);
  EXPECT_NEAR(reach("axial strip, pressed"), std::pow(1 / edge, 0.8), 1e-6);
  EXPECT_NEAR(reach("equibiaxial extension"), std::pow(edge, 0.6), 1e-6);
  EXPECT_NEAR(reach("equibiaxial compression"), std::pow(1 / edge, 0.6), 1e-6);
  EXPECT_NEAR(reach("confined compression"), 1 / edge, 1e-6);
  EXPECT_NEAR(reach("expansion"), std::cbrt(4.0), 1e-12);
  EXPECT_NEAR(reach("contraction"), std::cbrt(0.2), 1e-12);
  // The nearest to rest is told: ln of 2.868 and 0.3487 in strips, of 2.203 and 0.4538 in sheets.
  EXPECT_NEAR(std::abs(std::log(*found.ellipticity.first_lost)), 0.6 * std::log(edge), 1e-6);
  EXPECT_THAT(found.ellipticity.path, HasSubstr("equibiaxial"));
  EXPECT_THAT(found.sentences(), Contains(HasSubstr("ELLIPTICITY IS LOST at stretch")));
  EXPECT_EQ(found.transversely_stable(), std::nullopt);
}

// W = μ/2 (I1 − 3) + g(θ), θ = ln J: Q(n) = μ (n·b n) 1 + (g'' − g') n⊗n, b = F Fᵀ. With g = −μθ + Λ/2 θ² the factor is
// μ + Λ (1 − θ), and in pure expansion the least eigenvalue is μ J^(2/3) + μ + Λ (1 − ln J).
TEST(CompressibleStability, NeoHookeWithALogarithmIsLostInExpansion) {
  const double mu = 10, lambda = 60;
  const auto model = compressible(testing::make_model("neo_hooke"), "full", "logarithmic");
  const auto least = [&](double J) { return mu * std::cbrt(J * J) + mu + lambda * (1 - std::log(J)); };
  for (const double J : {0.3, 0.8, 1.0, 1.5, 2.5}) {
    const double x = std::cbrt(J);
    const auto found = least_wave_stiffness(*model, std::vector{mu, 1 / lambda}, {x, x, x});
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, std::min(least(J), mu * x * x), 1e-10 * lambda);
  }
  double low = 3, high = 20;
  ASSERT_TRUE(least(low) > 0 && least(high) < 0);
  while (high - low > 1e-12) (least(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  const Admissibility found = judged(*model, {mu, 1 / lambda}, 8);
  for (const PathReach& one : found.ellipticity.followed) {
    if (one.path == "expansion") {
      EXPECT_NEAR(one.to, std::cbrt(low), 1e-7);
    }
  }
  ASSERT_TRUE(found.ellipticity.first_lost);
  // K/2 (J − 1)² has g'' − g' = μ + K J²: elliptic everywhere, and free faces hold everywhere.
  const Admissibility quadratic =
      judged(*compressible(testing::make_model("neo_hooke"), "full", "quadratic"), {mu, 1 / lambda}, 3);
  EXPECT_FALSE(quadratic.ellipticity.first_lost);
  EXPECT_FALSE(quadratic.free_faces->first_lost);
  EXPECT_THAT(quadratic.sentences(), Contains("free faces stable from stretch 0.3333 to 3 in strips and sheets"));
  EXPECT_THAT(quadratic.sentences(), Contains(HasSubstr("elliptic from stretch 0.3333 to 3 in strips and sheets, and "
                                                        "from volume 0.3333 to 3; weakest")));
}

// Drucker's condition of the same material in expansion: D = Hessian of W over ln λ. With λ1 = λ2 = λ3 = x, D is
// 2 μ x² 1 + (g'') 11ᵀ; its eigenvalue along (1, 1, 1) is 2 μ x² + 3 Λ: always positive. K/2 (J − 1)² has g'' = −… + K
// J (2 J − 1), and is lost in contraction where 2 μ x² + 3 K J (2 J − 1) < 0.
TEST(CompressibleStability, DruckersConditionHasThreeStrains) {
  const double mu = 1, K = 60;
  const auto model = compressible(testing::make_model("neo_hooke"), "full", "quadratic");
  for (const double x : {0.6, 0.8, 1.0, 1.3}) {
    const double J = x * x * x;
    const auto found = least_drucker(*model, std::vector{mu, 1 / K}, {x, x, x});
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, std::min(2 * mu * x * x, 2 * mu * x * x + 3 * K * J * (2 * J - 1)), 1e-9);
  }
  const Admissibility found = judged(*model, {mu, 1 / K}, 2, 0.2);
  ASSERT_TRUE(found.drucker);
  const auto least = [&](double x) { return 2 * mu * x * x + 3 * K * x * x * x * (2 * x * x * x - 1); };
  double low = 0.5, high = 0.9;
  while (high - low > 1e-12) (least(0.5 * (low + high)) > 0 ? high : low) = 0.5 * (low + high);
  for (const PathReach& one : found.drucker->followed) {
    if (one.path == "contraction") {
      EXPECT_NEAR(one.to, low, 1e-7);
    }
  }
}

// K of free faces is the Hessian of W over the logarithms of their stretches, by differences at the state of a strip.
TEST(CompressibleStability, FreeFacesAreJudgedByTheHessianOfTheEnergy) {
  Options one;
  one.set("terms", std::int64_t{1});
  one.set("poisson", std::string("shared"));
  const auto foam = testing::make_model("hyperfoam", one);
  const std::vector<double> p{25, 6, 0.18};
  const double x = 1.2;
  const Admissibility found = judged(*foam, p, x);
  ASSERT_TRUE(found.free_faces);
  EXPECT_FALSE(found.free_faces->first_lost);
  double weakest = 1e300;
  for (int k = -25; k <= 25; ++k) {
    if (k == 0) continue;
    const double stretch = std::pow(x, k / 25.0), lateral = std::pow(stretch, -0.18), h = 1e-3;
    const auto W = [&](double a, double b) {
      const double second = lateral * std::exp(a), third = lateral * std::exp(b);
      return energy(*foam, p, {stretch * stretch, second * second, third * third, 0, 0, 0});
    };
    const double same = (W(h, 0) - 2 * W(0, 0) + W(-h, 0)) / (h * h);
    const double mixed = (W(h, h) - W(h, -h) - W(-h, h) + W(-h, -h)) / (4 * h * h);
    weakest = std::min(weakest, same - std::abs(mixed));
  }
  EXPECT_LE(found.free_faces->weakest, weakest * (1 + 1e-4));  // sheets are asked as well
  EXPECT_GT(found.free_faces->weakest, 0.5 * weakest);
}

TEST(CompressibleStability, TheReachIsWhatWasMeasured) {
  Domain domain;
  domain.largest = 2;
  EXPECT_EQ(domain.least(), 0.5);
  domain.strips[0] = {1.5, 0.7};
  EXPECT_EQ(domain.least(), 0.7);
}

}  // namespace
}  // namespace tunica::stability::compressible_test
