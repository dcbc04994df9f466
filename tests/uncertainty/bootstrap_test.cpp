// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/bootstrap.hpp"

#include <atomic>
#include <cmath>

#include <gmock/gmock.h>

#include "comparison/statistics.hpp"
#include "uncertainty/local.hpp"

using namespace tunica;
using uncertainty::Bootstrap;

namespace {

double sd_of(const Bootstrap& made, std::size_t j) {
  std::vector<double> sample;
  for (const auto& draw : made.draws) sample.push_back(draw.free[j]);
  return *comparison::sample_statistics(sample).sd;
}

}  // namespace

TEST(Bootstrap, HasTheStandardErrorsOfLinearRegression) {
  // Period 4 in 40 rows, mean zero and uncorrelated with constant and slope to 1 %; the lag-1 correlation is near 0.
  const trial::Line line(40);
  const auto made = uncertainty::bootstrap(line.assemble(), std::vector{1.0, 2.0}, trial::local(), 800, 7);
  EXPECT_EQ(made.failures, 0u);
  EXPECT_EQ(made.blocks[0], 1u);
  double mean = 0, xx = 0;
  for (const double x : line.x) mean += x / 40;
  for (const double x : line.x) xx += (x - mean) * (x - mean);
  const double s = 0.1 * std::sqrt(40.0 / 38), slope = s / std::sqrt(xx),
               constant = s * std::sqrt(1 / 40.0 + mean * mean / xx);
  // The standard deviation of 800 draws is known to 2.5 %: 10 % are four of those (false alarm 1 in 15 000).
  EXPECT_NEAR(sd_of(made, 1), slope, 0.1 * slope);
  EXPECT_NEAR(sd_of(made, 0), constant, 0.1 * constant);
  ASSERT_TRUE(made.ci95[1]);
  EXPECT_NEAR(made.ci95[1]->first, 2 - 1.96 * slope, 0.3 * slope);
  EXPECT_NEAR(made.ci95[1]->second, 2 + 1.96 * slope, 0.3 * slope);
}

TEST(Bootstrap, DrawsBlocksWhereNeighboursAreAlike) {
  const trial::Line smooth(fakes::grid(0, 7, 40),
                           [](std::size_t i) { return 0.1 * std::sin(0.6 * static_cast<double>(i)); });
  const auto made = uncertainty::bootstrap(smooth.assemble(), std::vector{1.0, 2.0}, trial::local(), 40, 7);
  EXPECT_GT(made.correlation[0], 0.7);
  EXPECT_GT(made.blocks[0], 3u);
  EXPECT_LE(made.blocks[0], 13u);
}

TEST(Bootstrap, CountsDrawsThatCannotBeFitted) {
  const trial::Line line;
  const auto assembly = line.assemble();
  std::atomic<int> calls = 0;
  fakes::set_behaviour([&](double, std::span<double>, Status& status) {
    if (++calls > 1) status = Status::failed("no");  // the first is the best fit itself
  });
  const auto made = uncertainty::bootstrap(assembly, std::vector{1.0, 2.0}, trial::local(), 50, 7);
  fakes::set_behaviour({});
  EXPECT_EQ(made.draws.size(), 50u);
  EXPECT_EQ(made.failures, 50u);
  EXPECT_FALSE(made.ci95[0]);
}

TEST(Bootstrap, MakesNoDrawsWhereTheBestPointCannotBeEvaluated) {
  const trial::Line line;
  const auto assembly = line.assemble();
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("no"); });
  const auto made = uncertainty::bootstrap(assembly, std::vector{1.0, 2.0}, trial::local(), 50, 7);
  fakes::set_behaviour({});
  EXPECT_TRUE(made.draws.empty());
}

TEST(Bootstrap, IsTheSameForAnyNumberOfThreads) {
  const trial::Line line;
  const auto assembly = line.assemble();
  const auto made = [&](int threads) {
    return trial::by_threads(threads, [&] {
      return uncertainty::bootstrap(assembly, std::vector{1.0, 2.0}, trial::local(), 60, 7);
    });
  };
  const auto one = made(1), two = made(2);
  for (std::size_t k = 0; k < 60; ++k) EXPECT_EQ(one.draws[k].free, two.draws[k].free);
}
