// SPDX-License-Identifier: Apache-2.0
#include "assembly/channel_noise.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include "assembly/smooth_shapes.hpp"
#include "calibration/fakes.hpp"

namespace tunica {
namespace {

using assembly::NoiseOrigin;
using testing::HasSubstr;

using Abscissae = std::vector<std::pair<std::string, std::vector<double>>>;

data::Channel column(std::vector<double> values) { return {"y", "kPa", std::move(values), {}, {}}; }

assembly::ChannelNoise noise_of(const data::Channel& of, const std::vector<double>& x) {
  std::vector<std::string> warnings;
  return assembly::channel_noise(of, {{"x", x}}, std::vector<bool>(x.size(), true), "test 't'", warnings);
}

/// Loading and unloading along different exponentials, n rows each, and a second curve that begins again.
void loop(std::size_t n, double sd, std::uint64_t seed, std::vector<double>& x, std::vector<double>& y) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal(0, sd);
  for (std::size_t branch = 0; branch < 4; ++branch)
    for (std::size_t i = 0; i < n; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(n - 1);
      x.push_back(branch % 2 == 0 ? share : 1 - share);
      y.push_back((branch < 2 ? 10 : 6) * std::exp((branch % 2 == 0 ? 3.0 : 3.5) * x.back()) + normal(generator));
    }
}

// Means over 200 loops of 4 × 20 rows, σ = 1: the standard error of a mean is some 0.008 of σ. The choice of the number
// of terms takes a few per cent away.
TEST(ChannelNoise, IsFoundAboutSmoothShapesOfLoopsWhateverTheirSteepness) {
  double mean = 0;
  constexpr int loops = 200;
  for (int k = 0; k < loops; ++k) {
    std::vector<double> x, y;
    loop(20, 1, static_cast<std::uint64_t>(k), x, y);
    const auto found = noise_of(column(y), x);
    ASSERT_EQ(found.origin, NoiseOrigin::smooth_shapes);
    mean += std::pow(found.rows.sd[0], 2) / loops;
  }
  EXPECT_NEAR(std::sqrt(mean), 1, 0.06);
}

// A second abscissa that is held, but for its own scatter, turns at every other row and ends no branch.
TEST(ChannelNoise, IsFoundBesideAnAbscissaThatTrembles) {
  std::vector<double> x, y, held;
  loop(10, 1, 3, x, y);
  for (std::size_t i = 0; i < x.size(); ++i) held.push_back(17 + 0.3 * static_cast<double>(i * 7 % 5));
  const std::vector<bool> all(x.size(), true);
  const auto alone = assembly::smooth_scatter(y, {{"x", x}}, all);
  const auto beside = assembly::smooth_scatter(y, {{"held", held}, {"x", x}}, all);
  ASSERT_TRUE(alone && beside);
  EXPECT_EQ(alone->variance, beside->variance);
  EXPECT_EQ(alone->freedom, beside->freedom);
}

TEST(ChannelNoise, OfAFewRowsOrConstantOnesIsAssumed) {
  for (const auto& [values, sd] :
       {std::pair{std::vector<double>{1, 2, 4}, 0.04}, {{5, 5, 5, 5, 5, 5}, 0.05}, {{0, 0, 0, 0, 0, 0}, 1.0}}) {
    const auto found = noise_of(column(values), fakes::grid(0, 1, values.size()));
    EXPECT_EQ(found.origin, NoiseOrigin::assumed);
    EXPECT_FALSE(found.known());
    EXPECT_NEAR(found.rows.sd[0], sd, 1e-12);
  }
}

// 40 rows rounded to 0.5, no other noise. σ of the rounding is 0.5/√12, whatever the shapes leave.
TEST(ChannelNoise, IsAtLeastThatOfRounding) {
  const auto x = fakes::grid(0, 1, 40);
  const auto found = noise_of(column(fakes::map(x, [](double at) { return std::round(2 * (3 + at)) / 2; })), x);
  EXPECT_GE(found.rows.sd[0], 0.5 / std::sqrt(12.0) - 1e-12);
  EXPECT_LT(found.rows.sd[0], 0.25);
}

TEST(ChannelNoise, ReadsStatementsAndReplicatesFirst) {
  data::Channel replicated = column({1, 2});
  replicated.replicates = {{0.9, 2.1}, {1.1, 1.9}};
  const auto found = noise_of(replicated, {0, 1});
  EXPECT_EQ(found.origin, NoiseOrigin::replicates);
  EXPECT_NEAR(found.rows.sd[1], std::sqrt(0.02 / 2), 1e-15);
  EXPECT_EQ(found.freedom, 2);
  replicated.noise = data::Noise{0.4, 0, 0};
  EXPECT_TRUE(noise_of(replicated, {0, 1}).stated());
  EXPECT_NEAR(noise_of(replicated, {0, 1}).rows.sd[0], 0.4 / std::sqrt(2), 1e-15);
}

TEST(ChannelNoise, LeastSquaresTakesAQuantisedChannelWithoutAStatement) {
  fakes::Bench bench;
  const auto x = fakes::grid(0, 3, 9);
  bench.add_test("t", x, {1, 1, 1, 1, 1, 1, 1, 1, 1});
  bench.run.objective = experiment::ObjectiveType::least_squares;
  const auto assembly = bench.assemble();
  EXPECT_THAT(assembly.layout().warnings, testing::IsEmpty());
  EXPECT_THAT(assembly.layout().notes,
              testing::ElementsAre(HasSubstr("no noise is stated, so all rows of a channel weigh the same")));
  double objective = 0;
  const auto workspace = assembly.evaluator().make_workspace();
  EXPECT_TRUE(assembly.evaluator().evaluate(std::vector{1.0, 0.1, 0.0}, objective, {}, {}, {}, *workspace).ok());
  EXPECT_TRUE(std::isfinite(objective));
}

}  // namespace
}  // namespace tunica
