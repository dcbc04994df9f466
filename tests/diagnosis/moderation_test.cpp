// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/moderation.hpp"

#include <cmath>
#include <random>

#include <boost/math/distributions/students_t.hpp>
#include <gmock/gmock.h>

namespace tunica::diagnosis {
namespace {

/// s² of eight channels whose σ lies between 1 and 2 % of their range, from 9 or 25 degrees of freedom.
struct Channels {
  std::vector<double> truth, ratios, freedom;
  explicit Channels(std::mt19937_64& generator) {
    std::uniform_real_distribution<double> sd(0.01, 0.02);
    for (const double nu : {25, 25, 9, 9, 9, 9, 9, 9}) {
      truth.push_back(std::pow(sd(generator), 2));
      freedom.push_back(nu);
      ratios.push_back(truth.back() * std::chi_squared_distribution<double>(nu)(generator) / nu);
    }
  }
};

// 4000 sets of 8: a normal error of the channel over its moderated σ is about Student's t of ν + d. Its share beyond
// the 95 % range has a standard deviation of 0.0012. It may be off by a hundredth: the scatter is uniform here and not
// d/χ²_d, and the common ratio is itself from eight channels.
TEST(Moderation, MakesVariancesBetterAndKeepsTheirUncertaintyHonest) {
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal;
  double beyond = 0, own = 0, moderated = 0, count = 0;
  for (int k = 0; k < 4000; ++k) {
    const Channels channels(generator);
    const Moderation others = moderation_of(channels.ratios, channels.freedom);
    ASSERT_GT(others.freedom, 0);
    for (std::size_t c = 0; c < channels.ratios.size(); ++c) {
      const double nu = channels.freedom[c], d = others.freedom;
      const double variance = (nu * channels.ratios[c] + d * others.ratio) / (nu + d);
      const double t = normal(generator) * std::sqrt(channels.truth[c] / variance);
      beyond += std::abs(t) > boost::math::quantile(boost::math::students_t(nu + d), 0.975);
      own += std::pow(std::log(channels.ratios[c] / channels.truth[c]), 2);
      moderated += std::pow(std::log(variance / channels.truth[c]), 2);
      count += 1;
    }
  }
  EXPECT_LT(moderated, 0.65 * own);
  EXPECT_LE(beyond / count, 0.06);
  EXPECT_GE(beyond / count, 0.04);
}

/// ψ and ψ′ by recurrence to an argument of 30, and the asymptotic series there.
double psi(double x) {
  double shift = 0;
  for (; x < 30; ++x) shift -= 1 / x;
  return shift + std::log(x) - 1 / (2 * x) - 1 / (12 * x * x) + 1 / (120 * std::pow(x, 4));
}
double psi_slope(double x) {
  double shift = 0;
  for (; x < 30; ++x) shift += 1 / (x * x);
  return shift + 1 / x + 1 / (2 * x * x) + 1 / (6 * std::pow(x, 3)) - 1 / (30 * std::pow(x, 5));
}

// With x_k = ln s² − ψ(ν/2) + ln(ν/2) the scatter is Var x − mean ψ′(ν/2), at least 0, and one standard error more, or
// 0.15; d has ψ′(d/2) of it, and the common ratio is that of which a channel with d/χ²_d has the mean x.
TEST(Moderation, IsThatOfTheScatterBetweenChannels) {
  struct Case {
    std::vector<double> ratios, freedom;
    double error;  ///< of the variance of x
  };
  for (const Case& one : {Case{{1, 5, 0.3, 2, 9}, {4, 7, 12, 30, 3}, std::sqrt(2.0 / 4)},
                          Case{{1, 1.7, 0.6, 1.3}, {3, 3, 3, 3}, std::sqrt(2.0 / 3)},
                          Case{{1e-200, 1e-200, 1e200, 1e200}, {9, 9, 9, 9}, std::sqrt(2.0 / 3)},
                          Case{{2, 2, 2, 2}, {9, 9, 9, 9}, std::sqrt(2.0 / 3)}}) {
    std::vector<double> x;
    double mean = 0, sampling = 0, variance = 0;
    const auto n = static_cast<double>(one.ratios.size());
    for (std::size_t k = 0; k < one.ratios.size(); ++k) {
      x.push_back(std::log(one.ratios[k]) - psi(one.freedom[k] / 2) + std::log(one.freedom[k] / 2));
      mean += x.back() / n;
      sampling += psi_slope(one.freedom[k] / 2) / n;
    }
    for (const double value : x) variance += std::pow(value - mean, 2) / (n - 1);
    const double scatter = std::max(0.15, std::max(0.0, variance - sampling) + variance * one.error);
    const Moderation found = moderation_of(one.ratios, one.freedom);
    EXPECT_NEAR(psi_slope(found.freedom / 2), scatter, 1e-6 * scatter);
    const double d = found.freedom;
    EXPECT_NEAR(std::log(found.ratio) + std::log(d / 2) - psi(d / 2), mean, 1e-6);
  }
}

// Channels whose noise has nothing to do with their range: a factor of e in σ between them is worth about one degree.
TEST(Moderation, IsNextToNothingWhereChannelsHaveLittleInCommon) {
  EXPECT_LT(moderation_of({1e-4, 1e-3, 1e-2, 1e-1, 1}, {20, 20, 20, 20, 20}).freedom, 1);
  EXPECT_EQ(moderation_of({1e-4, 1e-4, 1e-4}, {20, 20, 20}).freedom, 0);
}

}  // namespace
}  // namespace tunica::diagnosis
