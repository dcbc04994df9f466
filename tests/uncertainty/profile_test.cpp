// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/profile.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "uncertainty/identifiability.hpp"
#include "uncertainty/local.hpp"

using namespace tunica;
using uncertainty::Profile;
using Kind = Profile::End::Kind;

namespace {

std::vector<Profile> profiles(const assembly::Assembly& assembly, const std::vector<double>& best) {
  const auto likelihood = uncertainty::likelihood_at(assembly, best, trial::local(), 1);
  EXPECT_TRUE(likelihood.centre.status.ok()) << likelihood.centre.status.reason();
  std::vector<std::size_t> all(best.size());
  for (std::size_t j = 0; j < all.size(); ++j) all[j] = j;
  return uncertainty::profiles(assembly, likelihood, trial::local(), all, 1);
}

void expect_interval(const Profile& profile, double centre, double half) {
  EXPECT_EQ(profile.lower.kind, Kind::crossed);
  EXPECT_EQ(profile.upper.kind, Kind::crossed);
  EXPECT_NEAR(profile.lower.value, centre - half, 2e-3 * half);
  EXPECT_NEAR(profile.upper.value, centre + half, 2e-3 * half);
}

}  // namespace

TEST(Profile, OfALinearModelIsTheIntervalOfRegressionWhateverTheScale) {
  const trial::Line line;
  const auto made = profiles(line.assemble(), {1, 2});
  // Textbook, as in Identifiability.GivesTheIntervalsOfLinearRegression. b is searched on a log scale.
  const double s = std::sqrt(8 * 0.01 / 6), t = 2.446912;
  expect_interval(made[0], 1, t * s * std::sqrt(1.0 / 8 + 3.5 * 3.5 / 42));
  expect_interval(made[1], 2, t * s / std::sqrt(42));
  EXPECT_NEAR(made[0].threshold, t * t, 1e-5);
  EXPECT_GT(made[0].points.size(), 6u);
  for (const auto& point : made[1].points) {
    // Δ is a parabola: ((b − 2)/se)².
    EXPECT_NEAR(point.delta, std::pow((point.value - 2) / (s / std::sqrt(42)), 2), 1e-5);
    EXPECT_EQ(point.free[1], point.value);
  }
}

TEST(Profile, TakesStatedNoiseWithTheThresholdOfChiSquared) {
  trial::Line line;
  line.experiment.tests[0].data.noise = {{"y", {0.5, 0, 0}}};
  const auto made = profiles(line.assemble(), {1, 2});
  EXPECT_NEAR(made[1].threshold, 3.841459, 1e-5);
  expect_interval(made[1], 2, 1.959964 * 0.5 / std::sqrt(42));
}

TEST(Profile, StaysOpenWhereTheDataDoNotLimitAParameter) {
  fakes::Bench bench("valley");
  const auto x = fakes::grid(0, 3, 12);
  bench.add_test("t", x, fakes::map(x, [](double v) { return 7 * v + 2 * v * v + 0.01 * std::sin(40 * v); }));
  const auto made = profiles(bench.assemble(), {3, 1, 2});
  // 2p + q = 7 with q from 0 to 10: p is free down to its bound 0 and up to 3.5, where q ends.
  EXPECT_EQ(made[0].lower.kind, Kind::open);
  EXPECT_EQ(made[0].lower.value, 0);
  EXPECT_EQ(made[0].upper.kind, Kind::crossed);
  EXPECT_NEAR(made[0].upper.value, 3.5, 0.02);
  EXPECT_EQ(made[2].upper.kind, Kind::crossed);
}

TEST(Profile, FollowsTheLikelihoodWhereItIsNoParabola) {
  // One row measures b = 2 with σ = 1 and nothing else: on the log scale of the search the linearised interval is
  // 2 exp(±0.98), but the likelihood is normal in b itself.
  trial::Line line({1.0}, [](std::size_t) { return 0.0; });
  line.parameter("a").fixed = 1;
  line.experiment.tests[0].data.noise = {{"y", {0.5, 0, 0}}};
  const auto assembly = line.assemble();
  const auto made = profiles(assembly, {2});
  expect_interval(made[0], 2, 0.979982);
  uncertainty::Identifiability linear;
  ASSERT_TRUE(uncertainty::identify(assembly, std::vector{2.0}, linear).ok());
  EXPECT_NEAR(linear.parameters[0].lower, 2 * std::exp(-0.489991), 1e-6);
  EXPECT_NEAR(linear.parameters[0].upper, 2 * std::exp(0.489991), 1e-6);
}

TEST(Profile, NoticesThatItsCentreWasNoOptimum) {
  const trial::Line line;
  const auto assembly = line.assemble();
  auto likelihood = uncertainty::likelihood_at(assembly, std::vector{1.0, 2.0}, trial::local(), 1);
  likelihood.centre.objective += likelihood.scales[0];
  const auto made = uncertainty::profiles(assembly, likelihood, trial::local(), {0}, 1);
  EXPECT_LT(made[0].lowest, -0.5);
}

TEST(Profile, IsTheSameForAnyNumberOfThreads) {
  const trial::Line line;
  const auto assembly = line.assemble();
  const auto one = trial::by_threads(1, [&] { return profiles(assembly, {1, 2}); });
  const auto two = trial::by_threads(2, [&] { return profiles(assembly, {1, 2}); });
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(one[k].lower.value, two[k].lower.value);
    EXPECT_EQ(one[k].upper.value, two[k].upper.value);
    EXPECT_EQ(one[k].evaluations, two[k].evaluations);
  }
}

TEST(Profile, FailsAsAWholeWhereTheBestPointCannotBeEvaluated) {
  const trial::Line line;
  const auto assembly = line.assemble();
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("no"); });
  const auto likelihood = uncertainty::likelihood_at(assembly, std::vector{1.0, 2.0}, trial::local(), 1);
  fakes::set_behaviour({});
  EXPECT_EQ(likelihood.centre.status.reason(), "test 't': no");
}

TEST(Profile, EndsWhereRefitsFail) {
  const trial::Line line;
  const auto assembly = line.assemble();
  const auto likelihood = uncertainty::likelihood_at(assembly, std::vector{1.0, 2.0}, trial::local(), 1);
  fakes::set_behaviour([](double a, std::span<double>, Status& status) {
    if (a > 1.01) status = Status::failed("no");
  });
  const auto made = uncertainty::profiles(assembly, likelihood, trial::local(), {0}, 1);
  fakes::set_behaviour({});
  EXPECT_EQ(made[0].lower.kind, Kind::crossed);
  EXPECT_EQ(made[0].upper.kind, Kind::failed);
  EXPECT_NEAR(made[0].upper.value, 1.01, 1e-3);
  EXPECT_GT(made[0].failures, 0u);
}
