// SPDX-License-Identifier: Apache-2.0
// Noise of replicates and of neighbouring rows whose deviations are made, so that what they say is known exactly.
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "calibration/fakes.hpp"
#include "diagnosis/evidence/noise_statement.hpp"
#include "execution/folder.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::HasSubstr;
using Kind = NoiseSource::Kind;

struct Files : fakes::Bench {
  /// Two replicates, y + d and y − d: the unbiased square of a row is 2 d².
  experiment::TestEntry& add_pair(const std::string& name, const std::vector<double>& y, const std::vector<double>& d) {
    auto& entry = add_test(name, fakes::grid(0, 1, y.size()), y);
    const auto folder = entry.data.files.front().parent_path();
    entry.data.files.clear();
    for (const double sign : {1.0, -1.0}) {
      entry.data.files.push_back(folder / fmt::format("{}_{}.csv", name, sign));
      std::ofstream out(entry.data.files.back());
      out << "x [1],y [kPa],z [kPa]\n";
      for (std::size_t i = 0; i < y.size(); ++i) {
        const double value = y[i] + sign * d[i];
        out << fmt::format("{:.17g},{:.17g},{:.17g}\n", fakes::grid(0, 1, y.size())[i], value, 10 * value);
      }
    }
    return entry;
  }
  [[nodiscard]] std::vector<NoiseSource> sources(const std::vector<GrossRow>& gross = {}) const {
    return noise_sources(experiment, run.tests, shelf, gross);
  }
};

TEST(ExactReplicates, HaveTheMeanOfTheirSquares) {
  Files bench;
  bench.add_pair("t", {5, 5, 5, 5}, {3, 0.5, -1, 0.25});
  const NoiseSource source = bench.sources()[0];
  EXPECT_EQ(source.test, "t");
  EXPECT_EQ(source.channel, "y");
  EXPECT_EQ(source.unit, "kPa");
  EXPECT_EQ(source.kind, Kind::replicates);
  EXPECT_EQ(source.freedom, 4);
  EXPECT_NEAR(source.noise.absolute, std::sqrt(2 * (9 + 0.25 + 1 + 0.0625) / 4), 1e-12);
  EXPECT_EQ(source.noise.relative, 0);
  EXPECT_EQ(source.noise.correlation, 0);
}

/// Levels 0 … 20 in turn, or `scale` times these, with σ² = 0.25 (1 + share · (y/y_max)²) exactly, and signs that
/// change every `block` rows.
struct Grown : Files {
  Grown(std::size_t n, double share, std::size_t block = 1, double scale = 1) {
    std::vector<double> y, d;
    double mean = 0, logarithms = 0;
    for (std::size_t i = 0; i < n; ++i) {
      y.push_back(scale * static_cast<double>(i % 21));
      const double variance = 0.25 * (1 + share * std::pow(static_cast<double>(i % 21) / 20, 2));
      d.push_back(std::sqrt(variance / 2) * (i / block % 2 == 0 ? 1 : -1));
      mean += variance / static_cast<double>(n);
      logarithms += std::log(variance);
    }
    gain = static_cast<double>(n) * std::log(mean) - logarithms;
    add_pair("t", y, d);
  }
  double gain;  ///< of −2 ln L by the share
};

TEST(ExactReplicates, GrowWithTheValueWhereThatRaisesTheLikelihoodByFour) {
  const double share = 0.1 * std::pow(1.3, 15);  // 5.1, one of those that are tried
  for (const std::size_t n : {21, 42, 63}) {
    const Grown bench(n, share);
    const NoiseSource source = bench.sources()[0];
    ASSERT_TRUE(n == 21   ? bench.gain < 3.9
                : n == 42 ? bench.gain > 4.1 && bench.gain < 8
                          : bench.gain > 4)
        << bench.gain;
    EXPECT_NEAR(source.noise.relative, n == 21 ? 0 : 0.5 * std::sqrt(share) / 20, 1e-9) << n;
    EXPECT_TRUE(n == 21 || std::abs(source.noise.absolute - 0.5) < 1e-9) << source.noise.absolute;
  }
}

TEST(ExactReplicates, GrowWithSmallValuesTooAndByTheLikelihoodOfEveryRow) {
  const double share = 0.1 * std::pow(1.3, 15);
  const NoiseSource small = Grown(63, share, 1, 0.01).sources()[0];
  EXPECT_NEAR(small.noise.relative, 0.5 * std::sqrt(share) / 0.2, 1e-7);
  // Without the first row, the gain would be 3.96.
  const Grown bench(50, 0.1 * std::pow(1.3, 12));
  ASSERT_NEAR(bench.gain, 4.079, 1e-3);
  EXPECT_GT(bench.sources()[0].noise.relative, 0);
}

// 1 + share (y/y_max)² with shares below 100.
TEST(ExactReplicates, HaveAnAbsolutePartOfATenthAtLeast) {
  const NoiseSource source = Grown(63, 1e4).sources()[0];
  EXPECT_GT(source.noise.relative * 20 / source.noise.absolute, 9);
  EXPECT_LT(source.noise.relative * 20 / source.noise.absolute, 10);
}

// Deviations of ± σ/√2: of n − 1 pairs, those across a change of sign are negative.
TEST(ExactReplicates, HaveTheCorrelationOfNeighboursInTheirOwnNoise) {
  const NoiseSource source = Grown(63, 0.1 * std::pow(1.3, 15), 7).sources()[0];
  const double correlation = (62.0 - 2 * 8) / 62;
  ASSERT_GT(source.noise.relative, 0);
  EXPECT_NEAR(source.noise.correlation, correlation, 1e-9);
  EXPECT_NEAR(source.correlation_sd, std::sqrt((1 - correlation * correlation) / 63), 1e-9);
}

TEST(ExactReplicates, WeighPairsOfNeighboursByTheirSquares) {
  Files bench;
  const std::vector<double> d{3, 2, 2, 1, 2, 1, 1, 2};
  bench.add_pair("t", std::vector<double>(8, 5.0), d);
  double products = 0, squares = 0;
  for (std::size_t i = 1; i < 8; ++i) {
    products += d[i - 1] * d[i];
    squares += (d[i - 1] * d[i - 1] + d[i] * d[i]) / 2;
  }
  ASSERT_GT(products / squares, 2 / std::sqrt(8));
  EXPECT_NEAR(bench.sources()[0].noise.correlation, products / squares, 1e-12);
}

/// Constant deviations of n rows, of which so many pairs of neighbours have opposite signs.
std::vector<double> with_changes(std::size_t n, std::size_t changes) {
  std::vector<double> d{0.5};
  for (std::size_t i = 1; i < n; ++i) d.push_back(i <= changes ? -d.back() : d.back());
  return d;
}

/// What 101 rows with so many changes have: ρ of 100 pairs, 101 degrees of freedom.
double correlation_of(std::size_t changes) { return 1 - 2 * static_cast<double>(changes) / 100; }

NoiseSource of_changes(std::size_t changes) {
  Files bench;
  bench.add_pair("t", std::vector<double>(101, 5.0), with_changes(101, changes));
  return bench.sources()[0];
}

// 2/√101 = 0.199.
TEST(ExactReplicates, AreCorrelatedBeyondTwoStandardDeviations) {
  EXPECT_NEAR(of_changes(39).noise.correlation, 0.22, 1e-9);
  EXPECT_EQ(of_changes(41).noise.correlation, 0);
  EXPECT_EQ(of_changes(59).noise.correlation, 0);
  EXPECT_NEAR(of_changes(61).noise.correlation, -0.22, 1e-9);
}

std::vector<double> correlations_together(const std::vector<std::size_t>& changes) {
  Files bench;
  std::vector<double> found;
  for (std::size_t k = 0; k < changes.size(); ++k)
    bench.add_pair(std::to_string(k), std::vector<double>(101, 5.0), with_changes(101, changes[k]));
  for (const NoiseSource& source : bench.sources()) found.push_back(source.noise.correlation);
  return found;
}

// Σ (ρ − ρ̄)²/sd² is 101 · 2 · (half the difference)²: 3.84 is the 95 % point for two, 5.99 for three.
TEST(ExactReplicates, OfTestsThatAgreeHaveOneCorrelation) {
  const auto agreeing = correlations_together({20, 33}), apart = correlations_together({20, 34});
  EXPECT_NEAR(agreeing[0], (correlation_of(20) + correlation_of(33)) / 2, 1e-9);
  EXPECT_NEAR(agreeing[1], agreeing[0], 1e-12);
  EXPECT_NEAR(apart[0], correlation_of(20), 1e-9);
  EXPECT_NEAR(apart[1], correlation_of(34), 1e-9);
  // Three: 101 · 2 · (difference)² where the middle one is the mean.
  const auto three = correlations_together({20, 28, 36}), far = correlations_together({20, 29, 38});
  for (const double rho : three) EXPECT_NEAR(rho, correlation_of(28), 1e-9);
  EXPECT_NEAR(far[0], correlation_of(20), 1e-9);
  EXPECT_NEAR(far[2], correlation_of(38), 1e-9);
}

TEST(ExactReplicates, KnowTheirPooledCorrelationBetter) {
  Files bench;
  for (const char* name : {"s", "t"}) bench.add_pair(name, std::vector<double>(101, 5.0), with_changes(101, 20));
  bench.add_test("stated", {0, 1, 2}, {1, 2, 3}).data.noise = {{"y", {1, 0, 0}}};
  const auto found = bench.sources();
  for (const std::size_t k : {0, 1}) {
    EXPECT_NEAR(found[k].noise.correlation, 0.6, 1e-9);
    EXPECT_NEAR(found[k].correlation_sd, std::sqrt((1 - 0.36) / 202), 1e-9);
    EXPECT_EQ(found[k].freedom, 101);
  }
  EXPECT_EQ(found[2].kind, Kind::stated);
  EXPECT_EQ(found[2].noise.correlation, 0);
}

TEST(ExactReplicates, SayNothingOfAChannelThatIsStated) {
  Files bench;
  auto& entry = bench.add_pair("t", std::vector<double>(101, 5.0), with_changes(101, 20));
  entry.data.columns.emplace_back("z", "z");
  entry.weights.push_back(1);
  entry.data.noise = {{"z", {1, 0, 0.1}}};
  const auto found = bench.sources();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].noise.correlation, 0.6, 1e-9);
  EXPECT_EQ(found[1].noise.correlation, 0.1);
}

TEST(ExactReplicates, CountHoweverCloseTheyAre) {
  Files bench;
  bench.add_pair("t", {1, 2, 3}, {1e-8, 1e-8, 1e-8});
  EXPECT_NEAR(bench.sources()[0].noise.absolute, std::sqrt(2) * 1e-8, 1e-13);
}

TEST(ExactDifferences, HaveTheResolutionOfTheirStepOrTheirDigits) {
  Files bench;
  const std::vector<double> x = fakes::grid(0, 1, 8);
  bench.add_test("steps", x, {0, 0.2, 0.2, 0.4, 0.4, 0.6, 0.6, 0.6});
  bench.add_test("digits", x, {0, 0.011, 0.02, 0.15, 0.27, -0.313, 0.41, 0.1});
  const auto found = bench.sources();
  EXPECT_NEAR(found[0].resolution, 0.2 / std::sqrt(12), 1e-12);
  EXPECT_NEAR(found[1].resolution, 0.41e-5, 1e-12);
  EXPECT_EQ(found[0].kind, Kind::differences);
}

TEST(ExactDifferences, AreAHundredthOfTheLargestValueWhereThereAreNone) {
  Files bench;
  bench.add_test("two", {0, 1}, {3, -7});
  bench.add_test("line", fakes::grid(0, 4, 5), {0, 1, 2, 3, 4});
  const auto found = bench.sources();
  EXPECT_NEAR(found[0].noise.absolute, 0.07, 1e-12);
  EXPECT_EQ(found[0].neighbours, 0);
  EXPECT_EQ(found[0].freedom, 2);
  EXPECT_NEAR(found[1].noise.absolute, 0.04, 1e-12);
}

// Rows 1, 2 and 3 are (y₋ + y₊)/2 − y = −1, 1, −1 off the line, and 1.5 is the variance of that.
TEST(ExactDifferences, OfFewRowsHaveTwoDegreesOfFreedom) {
  Files bench;
  bench.add_test("t", fakes::grid(0, 4, 5), {0, 1, 0, 1, 0});
  const NoiseSource found = bench.sources()[0];
  EXPECT_NEAR(found.neighbours, std::sqrt(1 / 1.5), 1e-12);
  EXPECT_EQ(found.noise.absolute, found.neighbours);
  EXPECT_EQ(found.neighbours_freedom, 2) << "54/35 is less";
  EXPECT_EQ(found.freedom, 2);
}

TEST(ExactDifferences, RefuseValuesThatAreAllZero) {
  Files bench;
  bench.add_test("t", {0, 1, 2}, {0, 0, 0});
  EXPECT_EQ(trial::message_of<InputError>([&] { static_cast<void>(bench.sources()); }),
            "test 't', channel 'y': every value is 0, which says nothing about noise. State noise.absolute");
}

TEST(ExactDifferences, LeaveOutGrossRowsOfTheirChannel) {
  Files bench;
  std::vector<double> y;
  for (int i = 0; i < 20; ++i) y.push_back(i * i % 7 + (i == 9 ? 100 : 0));
  bench.add_test("t", fakes::grid(0, 19, 20), y);
  const auto of = [&](const std::vector<GrossRow>& gross) { return bench.sources(gross)[0].noise.absolute; };
  const double with = of({}), without = of({{"t", "y", 9, 9, 0, ""}});
  EXPECT_GT(with, 20);
  EXPECT_LT(without, 6);
  EXPECT_EQ(of({{"u", "y", 9, 9, 0, ""}}), with);
  EXPECT_EQ(of({{"t", "z", 9, 9, 0, ""}}), with);
  EXPECT_GT(of({{"t", "y", 3, 9, 0, ""}}), 20) << "another row";
}

TEST(WithNoise, ReplacesWhatTheTestsOfTheRunState) {
  Files bench;
  for (const char* name : {"s", "t"}) bench.add_test(name, {0, 1}, {0, 1}).data.noise = {{"y", {1, 0, 0}}};
  NoiseSource source{"s", "y", "kPa", Kind::stated, {0.25, 0.5, 0.125}};
  NoiseSource other{"t", "y", "kPa", Kind::stated, {4, 0, 0}};
  const auto found = with_noise(bench.experiment, {"s"}, {source, other});
  ASSERT_EQ(found.tests[0].data.noise.size(), 1u);
  EXPECT_EQ(found.tests[0].data.noise[0].second.absolute, 0.25);
  EXPECT_EQ(found.tests[0].data.noise[0].second.correlation, 0.125);
  ASSERT_EQ(found.tests[1].data.noise.size(), 1u);
  EXPECT_EQ(found.tests[1].data.noise[0].second.absolute, 1);
}

}  // namespace
}  // namespace tunica::diagnosis
