// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/encompassing_noise.hpp"

#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "diagnosis/detection/analysis.hpp"
#include "diagnosis/detection/noise_draws.hpp"
#include "diagnosis/evidence/estimate_warnings.hpp"
#include "diagnosis/evidence/row_correlation.hpp"
#include "diagnosis/evidence/smooth_columns.hpp"
#include "diagnosis/measured.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using trial::Measured;
using trial::Strip;

/// Up, half back, and up again.
std::vector<double> to_and_fro(std::size_t rows) {
  std::vector<double> stretch;
  for (std::size_t i = 0; i < rows; ++i) {
    const double way = 3 * static_cast<double>(i) / static_cast<double>(rows - 1);
    stretch.push_back(1.02 + 0.5 * (way < 1 ? way : way < 2 ? 2 - way : way - 2));
  }
  return stretch;
}

/// Two strips without stated noise.
struct SilentStrips : Measured {
  explicit SilentStrips(std::size_t rows = 45, double sd = 0.3)
      : Measured({{.stretch = to_and_fro(rows), .sd = sd}, {.name = "axial", .stretch = to_and_fro(rows), .sd = sd}}) {
    for (auto& [name, test] : experiment["tests"].items()) test["data"].erase("noise");
  }
};

Analysis analysed(const Measured& measured) {
  const experiment::Experiment own = measured.read();
  Request request = request_of(own);
  request.quick = true;
  const Progress silence;
  return analyse({own, request, testing::catalogue(), silence}, {});
}

/// A bend that no parameter of the wall follows, 20 σ high.
double bend(const Strip& strip, double stretch) { return strip.name == "axial" ? 6 * std::sin(9 * stretch) : 0; }

// Seeds 1 … 40; the mean over two channels of σ̂²/σ² has a standard deviation of √(2/(ν·80)); four of them: 6e-5. Where
// the noise is white, half of it at the largest value is taken for growing where the likelihood gains about 2 ln 2,
// one-sided 12 % of the data sets, and 5 % more for one observable; more than 15 of 40: 5e-4.
TEST(EncompassingNoise, IsUnbiasedBesideAMisfitOfManyTimesTheNoise) {
  double sum = 0, freedom = 0;
  int growing = 0;
  const SilentStrips measured;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    measured.measure(seed, {}, bend);
    const Analysis found = analysed(measured);
    EXPECT_TRUE(found.alarm.raised) << seed;
    const Eigen::VectorXd sd = whitened_deviations(found.evidence);
    sum += (sd / 0.3).squaredNorm() / static_cast<double>(sd.size()) / 40;
    const auto first = sd.head(45);
    growing += first.maxCoeff() > std::sqrt(2.0) * first.minCoeff();
    for (const NoiseSource& source : found.evidence.noise) {
      ASSERT_EQ(source.kind, NoiseSource::Kind::encompassing);
      freedom += source.freedom / 80;
    }
  }
  EXPECT_LE(growing, 15);
  EXPECT_GT(freedom, 15);
  EXPECT_NEAR(sum, 1, 4 * std::sqrt(2 / (freedom * 80)));
}

// Seeds 1 … 100, nothing hidden: p-values are uniform. Of 100, 20 are below 0.2; four standard deviations: 6e-5.
TEST(EncompassingNoise, KeepsTheAlarmCalibrated) {
  const SilentStrips measured;
  int low = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    measured.measure(seed);
    low += analysed(measured).alarm.p() <= 0.2;
  }
  EXPECT_NEAR(low, 20, 4 * std::sqrt(100 * 0.2 * 0.8));
}

// A sum over one channel of noise that is divided by its own σ̂ of ν degrees of freedom is Student's t of ν: its mean
// square is ν/(ν − 2). 4000 draws, four standard deviations of about √(3/4000): 6e-5.
TEST(EncompassingNoise, PutsItsOwnUncertaintyIntoEveryDraw) {
  const SilentStrips measured;
  measured.measure(1);
  const Evidence evidence = analysed(measured).evidence;
  const Eigen::MatrixXf draws = noise_draws(evidence, 4000, 1).residuals;
  for (const Curve& curve : evidence.curves) {
    // What lies in the span says nothing of σ̂: the mean of the curve does.
    const double mean_square =
        static_cast<double>(draws.middleRows(curve.first, curve.count).colwise().sum().squaredNorm()) /
        (4000 * static_cast<double>(curve.count));
    const double nu = curve.noise.freedom;
    EXPECT_NEAR(mean_square, nu / (nu - 2), 4 * std::sqrt(3.0 / 4000)) << curve.test;
  }
}

// Seed 3: 0.05 kPa and 4 % of a stress up to about 100 kPa.
TEST(EncompassingNoise, SeesNoiseThatGrowsWithTheValue) {
  const SilentStrips measured(120, 0.05);
  measured.measure(3);
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  for (const char* name : {"circumferential", "axial"}) {
    std::ifstream in(measured.folder.path() / fmt::format("{}.csv", name));
    std::string text, line;
    std::getline(in, line);
    text = line + '\n';
    while (std::getline(in, line)) {
      const auto comma = line.find(',');
      text += fmt::format("{},{}\n", line.substr(0, comma),
                          std::stod(line.substr(comma + 1)) * (1 + 0.04 * normal(generator)));
    }
    measured.folder.write(fmt::format("{}.csv", name), text);
  }
  for (const NoiseSource& source : analysed(measured).evidence.noise)
    EXPECT_NEAR(source.noise.relative, 0.04, 0.012) << source.test;
}

// Values in steps of 2 kPa without any other error: σ is not below 2/√12.
TEST(EncompassingNoise, IsNotBelowWhatRoundingLeaves) {
  const SilentStrips measured(45, 1e-3);
  measured.measure(4, {}, [](const Strip&, double) { return 0.0; });
  for (const char* name : {"circumferential", "axial"}) {
    std::ifstream in(measured.folder.path() / fmt::format("{}.csv", name));
    std::string text, line;
    std::getline(in, line);
    text = line + '\n';
    while (std::getline(in, line)) {
      const auto comma = line.find(',');
      text += fmt::format("{},{}\n", line.substr(0, comma), 2 * std::round(std::stod(line.substr(comma + 1)) / 2));
    }
    measured.folder.write(fmt::format("{}.csv", name), text);
  }
  for (const NoiseSource& source : analysed(measured).evidence.noise) {
    EXPECT_GE(source.noise.absolute, 2 / std::sqrt(12.0) * (1 - 1e-9)) << source.test;
    EXPECT_LE(source.noise.absolute, 2) << source.test;
  }
}

/// Errors of which each is 0.6 of the one before, beside their own.
Measured::Add autoregressive(std::map<std::string, double>& state, std::mt19937_64& generator) {
  return [&state, &generator](const Strip& strip, double) {
    std::normal_distribution<double> normal;
    double& error = state[strip.name];
    return error = 0.5 * error + std::sqrt(1 - 0.25) * normal(generator);
  };
}

// Seed 5: 2 · 150 rows with a correlation of 0.5 · 1/(1 + 0.01); the estimate is linear in it and lies below.
TEST(RowCorrelation, IsFoundAndSaidWhereRowsShareTheirErrors) {
  const SilentStrips measured(150, 0.1);
  std::mt19937_64 generator(5);
  std::map<std::string, double> state;
  measured.measure(5, {}, autoregressive(state, generator));
  const Evidence evidence = analysed(measured).evidence;
  const auto found = row_correlation(evidence, evidence.fit);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->sd, 1 / std::sqrt(300), 0.03);
  EXPECT_NEAR(found->value, 0.45, 4 * found->sd);
  ASSERT_EQ(evidence.noise_warnings.size(), 2u);
  EXPECT_EQ(evidence.noise_warnings[1].kind, WarningKind::rows_correlated);
  EXPECT_THAT(evidence.noise_warnings[1].text,
              HasSubstr(fmt::format("correlation {:.2f} ± {:.2f}", found->value, found->sd)));
}

// Seeds 1 … 60, independent rows: the mean lies within four of its standard deviations, 6e-5, and so does the mean
// square of value/sd about 1. Projection alone would make it −0.2.
TEST(RowCorrelation, IsNoneForIndependentRows) {
  const SilentStrips measured;
  double sum = 0, squares = 0, sd = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    measured.measure(seed);
    const Evidence evidence = analysed(measured).evidence;
    const auto found = row_correlation(evidence, evidence.fit);
    ASSERT_TRUE(found);
    sum += found->value / 60;
    squares += std::pow(found->value / found->sd, 2) / 60;
    sd = found->sd;
  }
  EXPECT_NEAR(sum, 0, 4 * sd / std::sqrt(60));
  EXPECT_NEAR(squares, 1, 4 * std::sqrt(2.0 / 60));
}

TEST(LoadingDirections, TurnAtTurningPointsAndNotWhereTheAbscissaTrembles) {
  EXPECT_THAT(loading_directions({0, 1, 2, 1.99, 3, 4, 3, 2, 2.01, 1}), ElementsAre(1, 1, 1, 1, 1, 1, -1, -1, -1, -1));
  EXPECT_THAT(loading_directions({0, 1, 2, 2, 2, 2, 1}), ElementsAre(1, 1, 1, 0, 0, 0, -1));
  EXPECT_THAT(loading_directions({1, 1, 1}), ElementsAre(1, 1, 1));
}

TEST(Contradiction, IsOfTheRatioOfTwoVariances) {
  NoiseSource source;
  source.kind = NoiseSource::Kind::encompassing;
  source.noise.absolute = source.neighbours = 1;
  source.freedom = source.neighbours_freedom = 20;
  EXPECT_NEAR(contradiction(source), 1, 0.01);
  source.neighbours = std::sqrt(3.318);  // the 99.5 % point of F(20, 20)
  EXPECT_NEAR(contradiction(source), 0.01, 1e-4);
}

}  // namespace
}  // namespace tunica::diagnosis
