// SPDX-License-Identifier: Apache-2.0
#include "posterior/convergence.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "posterior/counter_random.hpp"

using namespace tunica::posterior;

namespace {

/// Four chains x_t = φ x_{t−1} + √(1 − φ²) e, each about a centre of its own.
Chains chains_of(double phi, std::size_t length, const std::vector<double>& centres, std::uint64_t key) {
  CounterRandom random(key);
  Chains chains;
  for (const double centre : centres) {
    auto& chain = chains.emplace_back();
    double x = random.normal();
    for (std::size_t t = 0; t < length; ++t) {
      chain.push_back(centre + x);
      x = phi * x + std::sqrt(1 - phi * phi) * random.normal();
    }
  }
  return chains;
}
const std::vector<double> together(4, 0.0);

}  // namespace

// The effective size of an autoregressive chain is S (1 − φ)/(1 + φ). Its estimate from 40 000 draws scatters by some
// 3 %: 15 % is five of these. Key 1.
TEST(PosteriorConvergence, CountsWhatAutocorrelatedDrawsAreWorth) {
  for (const double phi : {0.0, 0.5, 0.9}) {
    const double expected = 40000 * (1 - phi) / (1 + phi);
    const auto found = convergence(chains_of(phi, 10000, together, 1));
    EXPECT_NEAR(found.bulk, expected, 0.15 * expected) << phi;
    EXPECT_LT(found.r_hat, 1.01) << phi;
  }
}

// Antithetic draws are worth more than their number.
TEST(PosteriorConvergence, CountsAlternatingDrawsAboveTheirNumber) {
  EXPECT_GT(convergence(chains_of(-0.5, 10000, together, 2)).bulk, 80000);
}

// One chain a standard deviation aside: B/n = 1/4 of the squared distance, so that R̂ ≈ √(1 + 3/16 · 4/3 …); far above
// 1.01 in any case, and with it the effective size falls.
TEST(PosteriorConvergence, FindsAChainThatLiesElsewhere) {
  const auto found = convergence(chains_of(0, 1000, {0, 0, 0, 1}, 3));
  EXPECT_GT(found.r_hat, 1.05);
  EXPECT_LT(found.bulk, 100);
}

// The same place and another width: R̂ of the values is blind to it, that of the distances from the median is not.
TEST(PosteriorConvergence, FindsAChainThatIsWider) {
  Chains chains = chains_of(0, 1000, together, 4);
  for (double& x : chains.back()) x *= 4;
  EXPECT_LT(split_r_hat(chains), 1.02);
  EXPECT_GT(convergence(chains).r_hat, 1.05);
}

// By hand: halves (1, 2), (3, 4), (2, 1), (4, 3) have W = 1/2 and means 1.5, 3.5, 1.5, 3.5 of variance 4/3, so that
// R̂² = (1/2 · 1/2 + 4/3)/(1/2) = 19/6.
TEST(PosteriorConvergence, IsTheFormula) {
  EXPECT_NEAR(split_r_hat({{1, 2, 3, 4}, {2, 1, 4, 3}}), std::sqrt(19.0 / 6), 1e-12);
}

TEST(PosteriorConvergence, DoesNotJudgeWhatDoesNotVary) {
  EXPECT_TRUE(std::isnan(convergence({{1, 1, 1, 1, 1}, {1, 1, 1, 1, 1}}).r_hat));
  EXPECT_TRUE(std::isnan(convergence({{1, 2}, {2, 1}}).bulk));
}
