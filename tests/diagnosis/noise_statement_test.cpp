// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/noise_statement.hpp"

#include <fstream>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "calibration/fakes.hpp"
#include "execution/folder.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::HasSubstr;

/// σ of a value, and the correlation of neighbouring rows.
struct Law {
  double absolute = 0, relative = 0, correlation = 0;
};

/// y = 1 + x² at 60 places up to x = 10, replicates with this noise.
struct Replicated : fakes::Bench {
  Replicated(const Law& law, std::size_t replicates, std::uint64_t seed,
             const std::vector<double>& x = fakes::grid(0, 10, 60)) {
    std::mt19937_64 generator(seed);
    std::normal_distribution<double> normal;
    auto& entry = add_test("t", x, x);
    const auto folder = entry.data.files.front().parent_path();
    entry.data.files.clear();
    for (std::size_t m = 0; m < replicates; ++m) {
      entry.data.files.push_back(folder / fmt::format("replicate_{}.csv", m));
      std::ofstream out(entry.data.files.back());
      out << "x [1],y [kPa]\n";
      double before = normal(generator);
      for (const double at : x) {
        const double y = 1 + at * at, sd = std::hypot(law.absolute, law.relative * y);
        out << fmt::format("{:.17g},{:.17g}\n", at, y + sd * before);
        before = law.correlation * before + std::sqrt(1 - law.correlation * law.correlation) * normal(generator);
      }
    }
  }
  NoiseSource stated() { return noise_sources(experiment, run.tests, shelf).front(); }
};

TEST(NoiseStatement, KeepsWhatTheFileStates) {
  Replicated bench({0.5}, 3, 1);
  bench.experiment.tests[0].data.noise = {{"y", {0.25, 0.01, 0.2}}};
  const NoiseSource source = bench.stated();
  EXPECT_EQ(source.kind, NoiseSource::Kind::stated);
  EXPECT_EQ(source.noise.absolute, 0.25);
  EXPECT_EQ(source.noise.relative, 0.01);
  EXPECT_EQ(source.noise.correlation, 0.2);
  EXPECT_EQ(source.freedom, 0);
}

// Seed 2; σ of 180 degrees of freedom has a standard deviation of 1/√360 of it: four of them, false alarm 6e-5. That
// a relative part is seen where there is none: 2.3 %; a correlation: 5 %; both are settled by the seed.
TEST(NoiseStatement, ReadsConstantNoiseOffReplicatesAndNoMore) {
  Replicated bench({0.5}, 4, 2);
  const NoiseSource source = bench.stated();
  EXPECT_EQ(source.kind, NoiseSource::Kind::replicates);
  EXPECT_EQ(source.freedom, 180);
  EXPECT_NEAR(source.noise.absolute, 0.5, 4 * 0.5 / std::sqrt(360.0));
  EXPECT_EQ(source.noise.relative, 0);
  EXPECT_EQ(source.noise.correlation, 0);
  EXPECT_EQ(source.correlation_sd, 0);
  const auto stated = with_noise(bench.experiment, bench.run.tests, {source});
  ASSERT_EQ(stated.tests[0].data.noise.size(), 1u);
  EXPECT_EQ(stated.tests[0].data.noise[0].second.absolute, source.noise.absolute);
}

// Seed 3; as above, and the levels of y, 1 … 101, hold the two parts apart to a factor of two in precision: 6e-5.
TEST(NoiseStatement, SeesNoiseThatGrowsWithTheValue) {
  const NoiseSource source = Replicated({0.5, 0.05}, 4, 3).stated();
  EXPECT_NEAR(source.noise.relative, 0.05, 8 * 0.05 / std::sqrt(360.0));
  EXPECT_GT(source.noise.absolute, 0.1);
  EXPECT_LT(source.noise.absolute, 1);
}

// Seeds 1 … 5; four stated standard deviations: false alarm 5 · 6e-5.
TEST(NoiseStatement, RecoversTheCorrelationOfNeighboursWithinWhatItStates) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const NoiseSource source = Replicated({0.5, 0, 0.3}, 6, seed).stated();
    ASSERT_GT(source.correlation_sd, 0) << seed;
    EXPECT_LT(source.correlation_sd, 0.07);
    EXPECT_NEAR(source.noise.correlation, 0.3, 4 * source.correlation_sd) << seed;
  }
}

// Seed 4; 58 overlapping differences of 60 rows: σ̂² of about 30 degrees of freedom; 4 standard deviations, 6e-5.
TEST(NoiseStatement, ElseTakesDifferencesOfNeighbouringRows) {
  Replicated bench({0.5}, 1, 4);
  const NoiseSource source = bench.stated();
  EXPECT_EQ(source.kind, NoiseSource::Kind::differences);
  EXPECT_NEAR(source.freedom, 58 * 18.0 / 35, 1e-9);
  EXPECT_NEAR(source.noise.absolute, 0.5, 4 * 0.5 / std::sqrt(2 * source.freedom));
  EXPECT_EQ(source.noise.correlation, 0);
}

// A hold has no neighbours on either side: its rows say nothing, and are no degrees of freedom.
TEST(NoiseStatement, CountsOnlyTheDifferencesThatItTook) {
  std::vector<double> x = fakes::grid(0, 10, 30);
  x.insert(x.end(), 30, 10.0);
  EXPECT_NEAR(Replicated({0.5}, 1, 6, x).stated().freedom, 28 * 18.0 / 35, 1e-9);
  // Nor are rows that are held out.
  Replicated bench({0.5}, 1, 6);
  bench.experiment.tests[0].hold_out.rows = data::RowRange{40, 60, 1};
  EXPECT_NEAR(bench.stated().freedom, 38 * 18.0 / 35, 1e-9);
}

TEST(NoiseStatement, RefusesIdenticalReplicates) {
  Replicated bench({0}, 3, 5);
  EXPECT_THAT(
      trial::message_of<InputError>([&] { bench.stated(); }),
      HasSubstr("channel 'y': the replicates are identical and say nothing about noise. State noise.absolute or "
                "noise.relative"));
}

TEST(NoiseStatement, LeavesTestsOfOtherRunsAlone) {
  Replicated bench({0.5}, 3, 6);
  EXPECT_TRUE(noise_sources(bench.experiment, {}, bench.shelf).empty());
  EXPECT_TRUE(bench.experiment.tests[0].data.noise.empty());
}

}  // namespace
}  // namespace tunica::diagnosis
