// SPDX-License-Identifier: Apache-2.0
// Noise that is stated is contradicted by the squares alone only where that is beyond doubt.
#include "diagnosis/detection/squares.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace tunica::diagnosis {
namespace {

/// Of 21 rows with residuals of this sum of squares, and one parameter, which takes one degree of freedom.
double p_of(double squares, std::vector<NoiseSource> noise, Eigen::Index rows = 21) {
  Evidence evidence;
  evidence.noise = std::move(noise);
  Fit fit;
  fit.residuals = Eigen::VectorXd::Constant(rows, std::sqrt(squares / static_cast<double>(rows)));
  fit.jacobian = Eigen::VectorXd::Ones(rows);
  fit.at_bound = {false};
  return p_of_squares(evidence, fit);
}

NoiseSource of_kind(NoiseSource::Kind kind) {
  NoiseSource source;
  source.kind = kind;
  return source;
}

// With 2m = 20 degrees of freedom P(χ² > x) = exp(−x/2) Σ_{k<m} (x/2)^k/k!.
double chi_squared_20_above(double x) {
  double term = 1, sum = 1;
  for (int k = 1; k < 10; ++k) sum += term *= x / 2 / k;
  return std::exp(-x / 2) * sum;
}

TEST(Squares, SayHowUnlikelyTheyAreWhereThatIsBeyondDoubt) {
  const NoiseSource stated = of_kind(NoiseSource::Kind::stated);
  ASSERT_LT(chi_squared_20_above(68), 1e-6);
  EXPECT_NEAR(p_of(68, {stated, stated}) / chi_squared_20_above(68), 1, 1e-9);
  ASSERT_GT(chi_squared_20_above(65), 1e-6);
  EXPECT_EQ(p_of(65, {stated}), 1) << "the draws decide";
  EXPECT_EQ(p_of(std::numeric_limits<double>::infinity(), {stated}), 1);
  EXPECT_LT(p_of(1e4, {stated}, 2), 1e-6);
  EXPECT_EQ(p_of(1e4, {stated}, 1), 1) << "no degree of freedom is left";
}

TEST(Squares, SayNothingWhereTheNoiseIsEstimated) {
  using Kind = NoiseSource::Kind;
  for (const Kind kind : {Kind::replicates, Kind::encompassing, Kind::differences})
    EXPECT_EQ(p_of(1000, {of_kind(Kind::stated), of_kind(kind)}), 1);
}

}  // namespace
}  // namespace tunica::diagnosis
