// SPDX-License-Identifier: Apache-2.0
// Smooth shapes that whatever is no noise may have.
#include "diagnosis/evidence/smooth_columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <gmock/gmock.h>

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A curve over this abscissa, after three rows of others and before two more.
Curve curve_over(std::vector<double> abscissa) {
  Curve curve;
  curve.first = 3;
  curve.count = static_cast<Eigen::Index>(abscissa.size());
  curve.abscissa = std::move(abscissa);
  return curve;
}

Eigen::MatrixXd columns_over(const std::vector<double>& abscissa) {
  const Eigen::MatrixXd all = smooth_columns({curve_over(abscissa)}, static_cast<Eigen::Index>(abscissa.size()) + 5);
  EXPECT_TRUE(all.topRows(3).isZero() && all.bottomRows(2).isZero()) << "rows of other curves";
  return all.middleRows(3, static_cast<Eigen::Index>(abscissa.size()));
}

/// n numbers from 1 to 2, closer together at the beginning.
std::vector<double> rising(std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = 1 + std::pow(static_cast<double>(i) / static_cast<double>(n - 1), 2);
  return x;
}

/// Legendre's polynomials of u, written out.
double legendre(Eigen::Index degree, double u) {
  const double v = u * u;
  switch (degree) {
    case 0:
      return 1;
    case 1:
      return u;
    case 2:
      return (3 * v - 1) / 2;
    case 3:
      return u * (5 * v - 3) / 2;
    case 4:
      return (35 * v * v - 30 * v + 3) / 8;
    default:
      return u * (63 * v * v - 70 * v + 15) / 8;
  }
}

TEST(SmoothColumns, ArePolynomialsUpToDegreeFiveAlongTheAbscissa) {
  const std::vector<double> x = rising(30);
  const Eigen::MatrixXd columns = columns_over(x);
  ASSERT_EQ(columns.cols(), 6);
  for (Eigen::Index i = 0; i < 30; ++i)
    for (Eigen::Index k = 0; k < 6; ++k)
      EXPECT_NEAR(columns(i, k), legendre(k, 2 * x[static_cast<std::size_t>(i)] - 3), 1e-12) << i << ' ' << k;
}

TEST(SmoothColumns, AreAtMostAThirdOfTheRows) {
  EXPECT_EQ(columns_over(rising(17)).cols(), 5);
  EXPECT_EQ(columns_over(rising(18)).cols(), 6);
  EXPECT_EQ(columns_over(rising(6)).cols(), 2);
  EXPECT_EQ(columns_over({1, 2}).cols(), 0);
}

TEST(SmoothColumns, AreTheRowsWhereTheAbscissaStandsStill) {
  const Eigen::MatrixXd columns = columns_over(std::vector<double>(9, 1.5));
  ASSERT_EQ(columns.cols(), 3);
  for (Eigen::Index i = 0; i < 9; ++i) EXPECT_NEAR(columns(i, 1), static_cast<double>(i) / 4 - 1, 1e-12);
}

// 19 rows up, the last one standing still, and 17 down. The polynomials up to degree 3 are there once more, times the
// direction.
TEST(SmoothColumns, HaveBranchesOfTheirOwnWhereTheCurveRunsToAndFro) {
  std::vector<double> x = rising(18), back(x.rbegin(), x.rend());
  x.insert(x.end(), back.begin(), back.end());
  const Eigen::MatrixXd columns = columns_over(x);
  ASSERT_EQ(columns.cols(), 10);
  const std::array<std::pair<Eigen::Index, bool>, 10> order{{{0, false},
                                                             {1, false},
                                                             {0, true},
                                                             {2, false},
                                                             {1, true},
                                                             {3, false},
                                                             {2, true},
                                                             {4, false},
                                                             {3, true},
                                                             {5, false}}};
  for (Eigen::Index i = 0; i < 36; ++i)
    for (Eigen::Index k = 0; k < 10; ++k) {
      const auto& [degree, directed] = order[static_cast<std::size_t>(k)];
      EXPECT_NEAR(columns(i, k),
                  legendre(degree, 2 * x[static_cast<std::size_t>(i)] - 3) * (directed && i > 18 ? -1 : 1), 1e-12)
          << i << ' ' << k;
    }
}

// Eight rows are a long hold: a parabola in the row.
TEST(SmoothColumns, HaveParabolasInLongHolds) {
  std::vector<double> x = rising(20);
  x.insert(x.end(), 6, 2.0);
  EXPECT_EQ(columns_over(x).cols(), 6) << "seven rows at 2";
  x.push_back(2.0);
  const Eigen::MatrixXd columns = columns_over(x);
  ASSERT_EQ(columns.cols(), 9);
  for (Eigen::Index i = 0; i < 27; ++i)
    for (Eigen::Index degree = 0; degree <= 2; ++degree)
      EXPECT_NEAR(columns(i, 6 + degree), i < 19 ? 0 : legendre(degree, 2 * static_cast<double>(i - 19) / 7 - 1), 1e-12)
          << i << ' ' << degree;
}

TEST(SmoothColumns, KnowADirectionOnlyWhereTheCurveTurns) {
  std::vector<double> x = rising(36);
  std::reverse(x.begin(), x.end());
  EXPECT_EQ(columns_over(x).cols(), 6) << "down only";
  for (const bool up : {true, false}) {  // one row alone beyond the turning point
    x = rising(17);
    if (!up) std::reverse(x.begin(), x.end());
    x.push_back(1.5);
    const Eigen::MatrixXd columns = columns_over(x);
    ASSERT_EQ(columns.cols(), 6);
    for (Eigen::Index i = 0; i < 18; ++i) EXPECT_EQ(columns(i, 2), (i < 17) == up ? 1 : -1) << i;
  }
}

// Of 36 rows there may be twelve columns, of 30 ten, of 27 nine.
TEST(SmoothColumns, OfAHoldAreThreeAtMost) {
  std::vector<double> x = rising(28);
  x.insert(x.end(), 8, 2.5);
  EXPECT_EQ(columns_over(x).cols(), 9);
  EXPECT_EQ(columns_over(std::vector<double>(30, 1.5)).cols(), 6) << "a curve that is held throughout has no other";
  x = rising(9);
  x.insert(x.end(), 9, 2.5);
  for (int i = 0; i < 9; ++i) x.push_back(3 + 0.1 * i);
  EXPECT_EQ(columns_over(x).cols(), 9) << "in the middle";
  x = rising(28);
  for (int i = 0; i < 8; ++i) x.push_back(2.5 + 1e-4 * (i % 2));
  for (double& value : x) value += 1000;
  EXPECT_EQ(columns_over(x).cols(), 6) << "a ten-thousandth of the range is no standstill, wherever the range lies";
}

TEST(SmoothColumns, StandSideBySideForSeveralCurves) {
  Curve first = curve_over(rising(6)), second = curve_over(rising(9));
  second.first = 9;
  const Eigen::MatrixXd all = smooth_columns({first, second}, 18);
  ASSERT_EQ(all.cols(), 5);
  EXPECT_TRUE(all.block(9, 0, 9, 2).isZero());
  EXPECT_TRUE(all.block(3, 2, 6, 3).isZero());
  EXPECT_EQ(all.col(2).segment(9, 9), Eigen::VectorXd::Ones(9));
}

TEST(LoadingDirections, TurnWhereTheAbscissaGoesBackByATwentiethOfItsRange) {
  EXPECT_THAT(loading_directions({0, 1, 2, 1, 0}), ElementsAre(1, 1, 1, -1, -1));
  EXPECT_THAT(loading_directions({2, 1, 0, 1}), ElementsAre(-1, -1, -1, 1));
  EXPECT_THAT(loading_directions({0, 0.5, 0.451, 1}), ElementsAre(1, 1, 1, 1)) << "it trembles";
  EXPECT_THAT(loading_directions({0, 0.5, 0.449, 1}), ElementsAre(1, 1, -1, 1));
  EXPECT_THAT(loading_directions({0, 0.04, -0.02, 1}), ElementsAre(1, 1, 1, 1)) << "before it sets out";
  EXPECT_THAT(loading_directions({0, 1, 0.97, 0.98, 0.5}), ElementsAre(1, 1, -1, -1, -1))
      << "from its highest point on";
}

TEST(LoadingDirections, DependOnNoUnitOfTheAbscissa) {
  for (const double unit : {1e-3, 10.0, 1e3}) {
    const auto scaled = [unit](std::vector<double> x) {
      for (double& value : x) value *= unit;
      return loading_directions(x);
    };
    EXPECT_THAT(scaled({0, 0.5, 0.451, 1}), ElementsAre(1, 1, 1, 1)) << unit;
    EXPECT_THAT(scaled({0, 0.5, 0.449, 1}), ElementsAre(1, 1, -1, 1)) << unit;
    EXPECT_THAT(scaled({0, 0.04, -0.02, 1}), ElementsAre(1, 1, 1, 1)) << unit;
    EXPECT_THAT(scaled({0, 0.5, 0.5 + 4e-7, 0.5, 0.5 - 4e-7, 1}), ElementsAre(1, 1, 0, 0, 0, 1)) << unit;
    EXPECT_THAT(scaled({0, 0.5, 0.5 + 4e-6, 0.5, 0.5 - 4e-6, 1}), ElementsAre(1, 1, 1, 1, 1, 1)) << unit;
  }
}

TEST(LoadingDirections, AreNoneInAHoldOfFourRows) {
  EXPECT_THAT(loading_directions({0, 1, 1, 1, 1, 2}), ElementsAre(1, 1, 0, 0, 0, 1));
  EXPECT_THAT(loading_directions({0, 1, 1, 1, 2}), ElementsAre(1, 1, 1, 1, 1));
  EXPECT_THAT(loading_directions({0, 1, 1, 1 + 1e-5, 1, 2}), ElementsAre(1, 1, 1, 1, 1, 1)) << "it moves";
  EXPECT_THAT(loading_directions({1, 1, 1, 1, 2}), ElementsAre(1, 0, 0, 0, 1)) << "from the first row on";
}

TEST(LoadingDirections, AreUpwardsWhereNothingMoves) {
  EXPECT_THAT(loading_directions({}), IsEmpty());
  EXPECT_THAT(loading_directions({1, 1, 1}), ElementsAre(1, 1, 1));
}

/// What the columns leave of a vector, as a share of it.
double left_by(const Eigen::MatrixXd& columns, const Eigen::VectorXd& vector) {
  return (vector - columns * columns.colPivHouseholderQr().solve(vector)).norm() / vector.norm();
}

// A second cycle that differs from the first is no noise, whatever it looks like.
TEST(SmoothColumns, LetEachBranchOfLaterCyclesHaveItsOwnShape) {
  constexpr std::size_t branch = 20;
  std::vector<double> x;
  for (std::size_t i = 0; i < 4 * branch; ++i) {
    const double t = static_cast<double>(i % branch) / branch;
    x.push_back(1 + ((i / branch) % 2 == 0 ? t : 1 - t));
  }
  Eigen::VectorXd bump = Eigen::VectorXd::Zero(4 * branch);
  // A valley begins a branch, a peak ends it.
  for (std::size_t i = 2 * branch; i <= 3 * branch; ++i) bump[static_cast<Eigen::Index>(i)] = x[i] * x[i] * x[i] - 1.5;
  const Eigen::MatrixXd columns = columns_over(x);
  EXPECT_LT(left_by(columns, bump), 1e-9);
  EXPECT_LE(columns.cols(), static_cast<Eigen::Index>(2 * branch));
  x.resize(2 * branch);
  EXPECT_GT(left_by(columns_over(x), Eigen::VectorXd::Unit(2 * branch, 30)), 0.5) << "a single row is no shape";
}

// Rows in any order turn at every step: these are no cycles.
TEST(SmoothColumns, SeeNoBranchesInRowsWithoutOrder) {
  std::vector<double> x = rising(40);
  for (std::size_t i = 0; i + 1 < x.size(); i += 2) std::swap(x[i], x[x.size() - 1 - i]);
  EXPECT_LE(columns_over(x).cols(), static_cast<Eigen::Index>(x.size() / 3));
}

}  // namespace
}  // namespace tunica::diagnosis
