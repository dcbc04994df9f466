// SPDX-License-Identifier: Apache-2.0
// Closed forms of the marginal likelihoods against sums over a fine grid of amplitudes.
#include "cohort_diagnosis/marginal.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "cohort_diagnosis/common_amplitude.hpp"
#include "cohort_diagnosis/pairs.hpp"
#include "constructed.hpp"

namespace tunica::cohort_diagnosis {
namespace {

double density(double y, const Population& population) {
  const double z = (y - population.mean) / population.sd;
  return std::exp(-z * z / 2) / (population.sd * std::sqrt(2 * M_PI));
}

double log_likelihood(const Half& half, double y) {
  const double a = half.length * y;
  return half.t * a - a * a / 2;
}

/// ∫ by the midpoint rule over a range that holds all of the population.
double by_sum(const Profile& profile, const Population& population) {
  constexpr int steps = 400000;
  const double from = population.mean - 12 * population.sd, width = 24 * population.sd / steps;
  double sum = 0, left = 0;
  for (int k = 0; k < steps; ++k) {
    const double y = from + (k + 0.5) * width;
    const std::optional<Half>& half = y > 0 ? profile.up : profile.down;
    if (!half) continue;
    const double p = density(y, population) * width;
    left += p;
    sum += p * std::exp(log_likelihood(*half, std::abs(y)));
  }
  return std::log(sum / left);
}

TEST(Marginal, OfTwoSidesIsTheIntegralOverThePopulation) {
  Profile profile;
  profile.up = Half{3.1, 2.0};
  profile.down = Half{-3.1, 2.0};
  for (const Population& population : {Population{1.2, 0.4}, Population{-0.8, 1.5}, Population{0, 2}})
    EXPECT_NEAR(log_marginal(profile, population), by_sum(profile, population), 1e-7);
}

TEST(Marginal, OfAKinkIsTheIntegralOfBothSides) {
  Profile profile;
  profile.up = Half{2.0, 1.0};
  profile.down = Half{0.7, 3.0};
  for (const Population& population : {Population{1.2, 0.4}, Population{-0.8, 1.5}, Population{0, 2}})
    EXPECT_NEAR(log_marginal(profile, population), by_sum(profile, population), 1e-7);
}

TEST(Marginal, OfOneSideIsCutOffAtTheNull) {
  Profile above, below;
  above.up = below.down = Half{1.5, 2.0};
  EXPECT_NEAR(log_marginal(above, {0.5, 0.7}), by_sum(above, {0.5, 0.7}), 1e-4);
  EXPECT_NEAR(log_marginal(above, {0, 1}), by_sum(above, {0, 1}), 1e-4);
  EXPECT_NEAR(log_marginal(below, {-0.5, 0.7}), log_marginal(above, {0.5, 0.7}), 1e-12);
}

TEST(Marginal, StaysFiniteFarFromTheNull) {
  Profile profile;
  profile.up = Half{-40, 10};
  EXPECT_TRUE(std::isfinite(log_marginal(profile, {0.1, 0.01})));
  EXPECT_NEAR(log_normal_below(-34.999), log_normal_below(-35.001), 0.1);
  EXPECT_NEAR(log_normal_below(-40), -804.608, 1e-3);
}

TEST(Marginal, OfAPairIsTheIntegralOverBothPopulations) {
  const Leg a{4.0, 2.0, 0}, b{-1.0, 1.5, 0};
  const double c = 0.6;
  const Population of_a{0.8, 0.5}, of_b{-0.2, 0.9};
  constexpr int steps = 1500;
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double x = of_a.mean + of_a.sd * (-9 + 18 * (i + 0.5) / steps);
      const double y = of_b.mean + of_b.sd * (-9 + 18 * (j + 0.5) / steps);
      const double log = a.u * x + b.u * y - (4 * x * x + 2 * c * 3 * x * y + 2.25 * y * y) / 2;
      sum += density(x, of_a) * density(y, of_b) * std::exp(log);
    }
  sum *= of_a.sd * of_b.sd * std::pow(18.0 / steps, 2);
  EXPECT_NEAR(log_marginal(a, b, c, of_a, of_b), std::log(sum), 1e-6);
}

TEST(Marginal, OfAPairWithNothingIsThatOfOne) {
  Profile profile;
  profile.up = Half{2.5, 2.0, 0, 1, false, false, 2.5};
  profile.down = Half{-2.5, 2.0, 0, -1, false, false, -2.5};
  EXPECT_NEAR(log_marginal(leg_of(profile), Leg{}, 0, {0.7, 0.3}, {0, 1}), log_marginal(profile, {0.7, 0.3}), 1e-12);
}

// 200 cohorts of ten, seed 11: mean 1, spread 0.3, each amplitude known to ± 0.25. A 95 % interval that covers in fewer
// than 180 has a probability below 0.001.
TEST(CommonAmplitude, CoversTheMeanOfThePopulation) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  Constructed rig;
  rig.length = 4;
  int covered = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<SpecimenEvidence> cohort;
    for (int s = 0; s < 10; ++s)
      cohort.push_back(rig.specimen("s" + std::to_string(s), {1 + 0.3 * normal(random), 0, 0}, random));
    const auto hypotheses = hypotheses_of(in_order(cohort));
    const auto found = common_amplitude(hypotheses.front(), std::vector<bool>(10, true));
    covered += found.low <= 1 && 1 <= found.high;
    EXPECT_LT(found.low, found.mean);
  }
  EXPECT_GE(covered, 180);
  EXPECT_LE(covered, 199);
}

}  // namespace
}  // namespace tunica::cohort_diagnosis
