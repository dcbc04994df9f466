// SPDX-License-Identifier: Apache-2.0
// σ from residuals that are made by hand: single rows that stand apart.
#include <gmock/gmock.h>

#include "diagnosis/hand_made.hpp"
#include "numerics/distributions.hpp"

namespace tunica::diagnosis {
namespace {

using Kind = NoiseSource::Kind;

/// A row with a column of its own against the others: P of as large a Student's t.
double chance_of_row(const Eigen::MatrixXd& X, const Eigen::VectorXd& r, Eigen::Index row) {
  const double freedom = static_cast<double>(X.rows() - X.cols() - 1);
  const double with = squares_outside(beside({X, Eigen::VectorXd::Unit(X.rows(), row)}), r);
  return 2 * numerics::student_above(std::sqrt((squares_outside(X, r) - with) / (with / freedom)), freedom);
}

TEST(SingleRows, StandApartBelowAChanceOfOneInTenThousandInAllRows) {
  OneCurve bed(24);
  bed.evidence.curves[0].noise.noise.correlation = 0.3;  // so that levels are what was measured
  const Eigen::MatrixXd X = bed.powers("s", 6), Y = beside({X, Eigen::VectorXd::Unit(24, 5)});
  const Eigen::VectorXd errors = bed.evidence.fit.residuals;
  for (const double share : {0.97, 1.03}) {
    Eigen::VectorXd r = errors;
    double low = 2, high = 1000;
    for (int i = 0; i < 60; ++i) {
      r[5] = (low + high) / 2;
      (chance_of_row(X, r, 5) > share * 1e-4 / 24 ? low : high) = r[5];
    }
    bed.evidence.fit.residuals = r;
    const NoiseEstimate found = bed.estimate();
    const bool apart = share < 1;
    EXPECT_NEAR(found.sources[0].freedom, apart ? 17 : 18, 1e-9);
    const double variance = apart ? squares_outside(Y, r) / 17 : squares_outside(X, r) / 18;
    EXPECT_NEAR(found.sources[0].noise.absolute, 0.5 * std::sqrt(variance), 1e-9);
    EXPECT_EQ(found.from.span.cols(), apart ? 7 : 6);
  }
}

TEST(SingleRows, AreOneInThirtyAtMostAndThoseFarthestApart) {
  OneCurve bed(60);
  bed.evidence.curves[0].noise.noise.correlation = 0.3;
  const std::vector<Eigen::Index> rows{0, 4, 9};
  const std::vector<double> sizes{60, 45, 30};
  for (std::size_t k = 0; k < 3; ++k) bed.evidence.fit.residuals[rows[k]] = sizes[k];
  const NoiseEstimate found = bed.estimate();
  const Eigen::MatrixXd X = beside({bed.powers("s", 6), Eigen::VectorXd::Unit(60, 0), Eigen::VectorXd::Unit(60, 4)});
  EXPECT_NEAR(found.sources[0].freedom, 52, 1e-9);
  EXPECT_NEAR(found.sources[0].noise.absolute, 0.5 * std::sqrt(squares_outside(X, bed.evidence.fit.residuals) / 52),
              1e-9);
  // Of fewer than sixty rows one, the one that stands farther apart.
  for (const std::size_t n : {40, 59}) {
    OneCurve few(n);
    few.evidence.curves[0].noise.noise.correlation = 0.3;
    few.evidence.fit.residuals[2] = 80;
    few.evidence.fit.residuals[8] = -72;
    const auto size = static_cast<Eigen::Index>(n);
    const double freedom = static_cast<double>(n) - 7, all = static_cast<double>(n);
    ASSERT_LT(chance_of_row(few.powers("s", 6), few.evidence.fit.residuals, 2), 1e-4 / all);
    const Eigen::MatrixXd Y = beside({few.powers("s", 6), Eigen::VectorXd::Unit(size, 2)});
    const NoiseSource source = few.estimate().sources[0];
    EXPECT_NEAR(source.freedom, freedom, 1e-9);
    EXPECT_NEAR(source.noise.absolute, 0.5 * std::sqrt(squares_outside(Y, few.evidence.fit.residuals) / freedom), 1e-9);
  }
}

TEST(SingleRows, AreNoneWhereTheFitFollowsThemMoreThanNineTenths) {
  for (const double leverage : {0.95, 0.85}) {
    OneCurve bed(24);
    const Eigen::MatrixXd X = bed.powers("s", 6);
    // Of what the shapes leave of row 11, this share is in the direction of a column.
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(24, 11),
                          left = (unit - X * X.colPivHouseholderQr().solve(unit)).normalized();
    Eigen::VectorXd other = rough(24, 5);
    other -= X * X.colPivHouseholderQr().solve(other);
    other = (other - left * left.dot(other)).normalized();
    const double own = squares_outside(X, unit), share = (leverage - (1 - own)) / own;
    bed.add_column(std::sqrt(share) * left + std::sqrt(1 - share) * other);
    bed.evidence.fit.residuals = 0.01 * rough(24, 2);
    bed.evidence.fit.residuals[11] = 50;
    EXPECT_NEAR(bed.estimate().sources[0].freedom, leverage > 0.9 ? 17 : 16, 1e-9);
  }
}

TEST(SingleRows, TakeThreeDegreesOfFreedomOfTheOthers) {
  for (const Eigen::Index few : {4, 8}) {
    HandMade bed;
    const std::vector<double> x = fakes::grid(0, 1, 24), short_x = fakes::grid(0, 1, static_cast<std::size_t>(few));
    bed.add("s", x, rising(x), {0.5, 0, 0});
    bed.add("t", short_x, rising(short_x), {0.5, 0, 0});
    bed.source("t").unit = "N";
    bed.close();
    bed.evidence.fit.residuals << shrinking(24, 1), shrinking(few, 2);
    bed.evidence.fit.residuals[24 + 1] = 1e6;
    EXPECT_NEAR(of(bed.estimate(), "t").freedom, few == 4 ? 3 : 5, 1e-9) << "of 4 − 1, and of 8 − 2 − 1";
  }
}

// Nothing but one row, as far off as all 18 degrees of freedom may be together, and a little less.
TEST(SingleRows, AreNoneOfNoiseThatIsTheResolution) {
  OneCurve bed(24, 0.5);
  const Eigen::MatrixXd X = bed.powers("s", 6);
  bed.evidence.fit.residuals *= 0.01;
  bed.evidence.fit.residuals[11] = std::sqrt(16 / squares_outside(X, Eigen::VectorXd::Unit(24, 11)));
  ASSERT_LT(squares_outside(X, bed.evidence.fit.residuals), 18);
  ASSERT_LT(chance_of_row(X, bed.evidence.fit.residuals, 11), 1e-9);
  const NoiseEstimate found = bed.estimate();
  EXPECT_EQ(found.from.span.cols(), 6);
  EXPECT_EQ(found.sources[0].freedom, 0);
}

TEST(SingleRows, StandApartFromOthersThatDoNotErrAtAll) {
  for (const Eigen::Index row : {3, 7, 8, 11, 15, 16}) {
    OneCurve bed(24);
    bed.evidence.fit.residuals.setZero();
    bed.evidence.fit.residuals[row] = 40;
    EXPECT_LT(bed.estimate().sources[0].noise.absolute, 1e-3) << row;
  }
}

TEST(SingleRows, OfKnownNoiseAreNoMatter) {
  HandMade bed;
  const std::vector<double> x = fakes::grid(0, 1, 24);
  bed.add("u", x, rising(x), {0.5, 0, 0}, Kind::stated);
  bed.add("s", x, rising(x), {0.5, 0, 0});
  bed.close();
  bed.evidence.fit.residuals << shrinking(24, 1), shrinking(24, 2);
  bed.evidence.fit.residuals[9] = 1000;
  EXPECT_EQ(bed.estimate().from.span.cols(), 12);
}

}  // namespace
}  // namespace tunica::diagnosis
