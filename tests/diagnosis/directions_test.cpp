// SPDX-License-Identifier: Apache-2.0
// What a hypothesis weighs before the data, and the smooth shapes that a misfit may have.
#include "diagnosis/hypotheses/directions.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/detection/shapes.hpp"

namespace tunica::diagnosis::directions_test {
namespace {

using Side = MechanismFactory::Side;
using ::testing::ElementsAre;

Hypothesis hypothesis(Eigen::Index axis, std::optional<std::size_t> row = {}, Side side = Side::both) {
  Hypothesis one;
  one.signature = Eigen::VectorXd::Unit(8, axis);
  one.addition.place.row = row;
  one.side = side;
  return one;
}

/// A refit takes the last axis only, which no hypothesis has.
const Projection absorbed(Eigen::MatrixXd(Eigen::VectorXd::Unit(8, 7)));

/// Whole curves and single rows are two kinds of equal weight; directions of a kind are equal.
TEST(Directions, ShareTheWeightOfTheirCandidateByKind) {
  std::vector<Candidate> candidates(3);
  candidates[0].hypotheses = {hypothesis(0), hypothesis(1), hypothesis(2)};
  candidates[1].hypotheses = {hypothesis(0), hypothesis(1, 4), hypothesis(2, 5), hypothesis(3, 0), hypothesis(4, 1)};
  candidates[2].hypotheses = {hypothesis(5, 2)};
  std::vector<double> shares;
  std::vector<bool> rows;
  for (const Direction& one : directions(candidates, absorbed)) {
    shares.push_back(one.share);
    rows.push_back(one.row);
  }
  EXPECT_THAT(shares, ElementsAre(1. / 3, 1. / 3, 1. / 3, 0.5, 0.125, 0.125, 0.125, 0.125, 1));
  EXPECT_THAT(rows, ElementsAre(false, false, false, false, true, true, true, true, true));
}

/// Half of the prior of a one-sided amplitude would lie where it cannot be.
TEST(Directions, WeighOneSideTwice) {
  std::vector<Candidate> candidates(1);
  candidates[0].hypotheses = {hypothesis(0), hypothesis(1, {}, Side::positive), hypothesis(2, {}, Side::even)};
  const auto all = directions(candidates, absorbed);
  EXPECT_NEAR(log_prior(all[0]), std::log(1. / 3), 1e-15);
  EXPECT_NEAR(log_prior(all[1]), std::log(2. / 3), 1e-15);
  EXPECT_NEAR(log_prior(all[2]), std::log(2. / 3), 1e-15);
}

/// T/2 + ln prior: one side weighs as much as a T that is larger by 2 ln 2 = 1.39.
TEST(Directions, TheLikeliestHasTheLargestScoreAndPrior) {
  std::vector<Candidate> candidates(2);
  candidates[0].hypotheses = {hypothesis(0), hypothesis(1, {}, Side::positive)};
  candidates[1].hypotheses = {hypothesis(2)};
  const auto all = directions(candidates, absorbed);
  Eigen::VectorXd r = Eigen::VectorXd::Zero(8);
  r[1] = 2;
  r[2] = 50;
  r[0] = -std::sqrt(4 + 1.3);
  EXPECT_EQ(likeliest_direction(all, r, 0), 1u);
  r[0] = -std::sqrt(4 + 1.5);
  EXPECT_EQ(likeliest_direction(all, r, 0), 0u);
  EXPECT_EQ(likeliest_direction(all, r, 1), 2u);
  EXPECT_EQ(likeliest_direction(all, r, 2), std::nullopt);
  EXPECT_EQ(likeliest_direction(all, Eigen::VectorXd::Zero(8), 1), 2u) << "it has one all the same";
}

Curve curve(Eigen::Index first, std::vector<double> abscissa) {
  Curve one;
  one.first = first;
  one.count = static_cast<Eigen::Index>(abscissa.size());
  one.abscissa = std::move(abscissa);
  return one;
}

/// Legendre polynomials of u from −1 to 1 over the range of the abscissa: 1, u, (3u² − 1)/2.
TEST(SmoothShapes, OfACurveAreThreePolynomials) {
  const Shapes shapes = smooth_shapes({curve(1, {1, 1.5, 2, 3})}, 6);
  EXPECT_THAT(shapes.curve, ElementsAre(0, 0, 0));
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(6, 3);
  expected.middleRows(1, 4) << 1, -1, 1, 1, -0.5, -0.125, 1, 0, -0.5, 1, 1, 1;
  EXPECT_LT((shapes.columns - expected).norm(), 1e-15) << shapes.columns;
}

/// To and fro: the first two times the direction too, a row that stands still has that of the one before.
TEST(SmoothShapes, OfACycleKnowTheDirection) {
  const Shapes shapes = smooth_shapes({curve(0, {5, 5.5}), curve(2, {0, 1, 2, 2, 1})}, 7);
  EXPECT_THAT(shapes.curve, ElementsAre(0, 0, 0, 1, 1, 1, 1, 1));
  Eigen::MatrixXd expected(5, 5);
  expected << 1, -1, 1, 1, -1,  //
      1, 0, -0.5, 1, 0,         //
      1, 1, 1, 1, 1,            //
      1, 1, 1, 1, 1,            //
      1, 0, -0.5, -1, 0;
  EXPECT_LT((shapes.columns.bottomRightCorner(5, 5) - expected).norm(), 1e-15) << shapes.columns;
  EXPECT_EQ(shapes.columns.topRightCorner(2, 5).norm(), 0);
  // Downwards only is no cycle; at one abscissa nothing varies.
  EXPECT_EQ(smooth_shapes({curve(0, {2, 1, 0})}, 3).columns.cols(), 3);
  const Shapes still = smooth_shapes({curve(0, {2, 2})}, 2);
  ASSERT_EQ(still.columns.cols(), 3);
  EXPECT_EQ(still.columns.col(1).norm(), 0);
  EXPECT_EQ(smooth_shapes({curve(0, {2})}, 1).columns(0, 0), 1);
  // A first row that stands still has no direction yet.
  EXPECT_EQ(smooth_shapes({curve(0, {1, 1, 2, 1})}, 4).columns(0, 3), 0);
}

}  // namespace
}  // namespace tunica::diagnosis::directions_test
