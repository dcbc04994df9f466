// SPDX-License-Identifier: Apache-2.0
// σ from residuals that are made by hand. Errors are values of a sine, so that nothing is drawn.
#include <Eigen/QR>
#include <gmock/gmock.h>

#include "assembly/restricted_variance.hpp"
#include "diagnosis/evidence/encompassing_noise.hpp"
#include "diagnosis/hand_made.hpp"

namespace tunica::diagnosis {
namespace {

using assembly::known_variance;
using Kind = NoiseSource::Kind;

/// σ of every row of a rising curve.
Eigen::VectorXd deviations_of(const std::vector<double>& x, const data::Noise& noise) {
  Eigen::VectorXd sd(static_cast<Eigen::Index>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i)
    sd[static_cast<Eigen::Index>(i)] = std::hypot(noise.absolute, noise.relative * (2 + 10 * x[i]));
  return sd;
}

TEST(EstimatedNoise, IsTheMeanSquareOutsideTheJacobianAndSmoothShapesOfEachCurve) {
  HandMade bed;
  const std::vector<double> x = fakes::grid(0, 1, 24), far = fakes::grid(2, 4, 31);
  const data::Noise of_s{0.5, 0.04, 0}, of_t{0.1, 0.03, 0};
  bed.add("s", x, rising(x), of_s);
  bed.add("t", far, rising(far), of_t, Kind::encompassing);
  bed.close();
  const Eigen::VectorXd s = deviations_of(x, of_s), t = deviations_of(far, of_t);
  const Eigen::VectorXd errors = shrinking(24, 1), others = 0.2 * shrinking(31, 2);
  bed.evidence.fit.residuals << errors.cwiseQuotient(s), others.cwiseQuotient(t);
  bed.add_column(bed.in_curve("s", rough(24, 3)));
  bed.add_column(rough(55, 4), true);  // at a bound: no refit moves it
  bed.add_column(bed.in_curve("t", rough(31, 5)));
  const NoiseEstimate found = bed.estimate();
  ASSERT_EQ(found.sources.size(), 2u);

  const Eigen::MatrixXd X = beside({bed.evidence.fit.jacobian.col(0), bed.powers("s", 6)}).topRows(24),
                        Y = beside({bed.evidence.fit.jacobian.col(2), bed.powers("t", 6)}).bottomRows(31);
  const double first = squares_outside(s.asDiagonal() * X, errors) / (24 - 7),
               second = squares_outside(t.asDiagonal() * Y, others) / (31 - 7);
  EXPECT_NEAR(found.sources[0].noise.absolute, std::sqrt(first), 1e-9);
  EXPECT_NEAR(found.sources[1].noise.absolute, std::sqrt(second), 1e-9);
  EXPECT_NEAR(found.sources[0].freedom, 17, 1e-9);
  EXPECT_NEAR(found.sources[1].freedom, 24, 1e-9);
  for (const NoiseSource& one : found.sources) {
    EXPECT_EQ(one.kind, Kind::encompassing);
    EXPECT_EQ(one.noise.relative, 0);
    EXPECT_EQ(one.noise.correlation, 0);
  }
  // What it is from: two groups of rows, and 14 columns that hold all of that in whitened rows.
  std::vector<std::size_t> groups(24, 0);
  groups.resize(55, 1);
  EXPECT_EQ(found.from.group, groups);
  EXPECT_EQ(found.from.moderation, 0);
  ASSERT_EQ(found.from.span.cols(), 14);
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(55, 14);
  blocks.topLeftCorner(24, 7) = X;
  blocks.bottomRightCorner(31, 7) = Y;
  for (Eigen::Index k = 0; k < 14; ++k) EXPECT_LT(outside(found.from.span, blocks.col(k)), 1e-9) << k;
}

TEST(EstimatedNoise, LeavesStatedChannelsAloneAndTakesTheirRowsAsKnown) {
  HandMade bed;
  const std::vector<double> x = fakes::grid(0, 1, 24);
  bed.add("s", x, rising(x), {0.5, 0, 0});
  bed.add("u", x, rising(x), {0.3, 0, 0}, Kind::stated);
  bed.add("t", x, rising(x), {0.25, 0, 0});
  bed.close();
  bed.evidence.fit.residuals << 2 * shrinking(24, 1), shrinking(24, 2), 4 * shrinking(24, 3);
  bed.add_column(rough(72, 4));  // joins them
  const NoiseEstimate found = bed.estimate();

  // The same in kPa, where the noise of "u" is known.
  assembly::VarianceProblem problem;
  Eigen::VectorXd sd(72);
  sd << Eigen::VectorXd::Constant(24, 0.5), Eigen::VectorXd::Ones(24), Eigen::VectorXd::Constant(24, 0.25);
  problem.columns =
      sd.asDiagonal() * beside({bed.evidence.fit.jacobian, bed.powers("s", 6), bed.powers("u", 6), bed.powers("t", 6)});
  problem.residuals = sd.cwiseProduct(bed.evidence.fit.residuals);
  problem.shape = Eigen::VectorXd::Ones(72);
  problem.group.assign(24, 0);
  problem.group.resize(48, known_variance);
  problem.group.resize(72, 1);
  const auto expected = restricted_variance(problem);
  EXPECT_EQ(found.from.group, problem.group);
  EXPECT_NEAR(of(found, "s").noise.absolute, std::sqrt(expected.variance[0]), 1e-5);
  EXPECT_NEAR(of(found, "t").noise.absolute, std::sqrt(expected.variance[1]), 1e-5);
  EXPECT_NEAR(of(found, "s").freedom, expected.freedom[0], 1e-4);
  EXPECT_NEAR(of(found, "t").freedom, expected.freedom[1], 1e-4);
  EXPECT_EQ(of(found, "u").kind, Kind::stated);
  EXPECT_EQ(of(found, "u").noise.absolute, 0.3);
}

TEST(EstimatedNoise, IsOneForTheChannelsOfAnObservableWhereOneHasFewRows) {
  HandMade bed;
  const std::vector<double> x = fakes::grid(0, 1, 24), few = fakes::grid(0, 1, 4);
  bed.add("t", few, rising(few), {0.25, 0, 0});
  bed.add("v", x, rising(x), {0.2, 0, 0});
  bed.add("s", x, rising(x), {0.5, 0, 0});
  bed.source("v").unit = "N";  // another observable
  bed.close();
  const Eigen::VectorXd t = 2 * shrinking(4, 3), v = 3 * shrinking(24, 2), s = shrinking(24, 1);
  bed.evidence.fit.residuals << t / 0.25, v / 0.2, s / 0.5;
  const NoiseEstimate found = bed.estimate();
  const double together =
                   squares_outside(bed.powers("s", 6).bottomRows(24), s) + squares_outside(Eigen::VectorXd::Ones(4), t),
               other = squares_outside(bed.powers("v", 6).middleRows(4, 24), v);
  for (const char* name : {"s", "t"}) {
    EXPECT_NEAR(of(found, name).noise.absolute, std::sqrt(together / (18 + 3)), 1e-9) << name;
    EXPECT_NEAR(of(found, name).freedom, 21, 1e-9) << name;
  }
  EXPECT_NEAR(of(found, "v").noise.absolute, std::sqrt(other / 18), 1e-9);
  EXPECT_NEAR(of(found, "v").freedom, 18, 1e-9);
  std::vector<std::size_t> groups(4, 0);
  groups.resize(28, 1);
  groups.resize(52, 0);
  EXPECT_EQ(found.from.group, groups);
}

TEST(EstimatedNoise, StaysAsItWasWhereNothingIsLeftToLearnFrom) {
  HandMade bed;
  const std::vector<double> x = fakes::grid(0, 1, 24), two{0, 1};
  bed.add("t", two, rising(two), {0.25, 0, 0});
  bed.add("s", x, rising(x), {0.5, 0, 0});
  bed.source("t").unit = "N";
  bed.close();
  bed.evidence.fit.residuals << 1, 2, shrinking(24, 1);
  bed.add_column(Eigen::VectorXd::Unit(26, 0));
  const NoiseEstimate found = bed.estimate();
  EXPECT_EQ(of(found, "t").kind, Kind::differences);
  EXPECT_EQ(of(found, "t").noise.absolute, 0.25);
  EXPECT_EQ(of(found, "t").freedom, 3);
  EXPECT_NEAR(of(found, "s").freedom, 18, 1e-9);
  std::vector<std::size_t> groups(2, known_variance);
  groups.resize(26, 1);
  EXPECT_EQ(found.from.group, groups);
}

TEST(EstimatedNoise, IsKnownWhereItIsTheResolutionOfTheValues) {
  HandMade bed;
  const std::vector<double> x = fakes::grid(0, 1, 24), few = fakes::grid(0, 1, 4);
  bed.add("s", x, rising(x), {0.5, 0, 0});
  bed.add("t", few, rising(few), {0.5, 0, 0});
  bed.add("v", x, rising(x), {0.5, 0, 0});
  bed.source("v").unit = "N";
  bed.source("s").resolution = 0.01;
  bed.source("t").resolution = 3;  // of the two that are pooled, the larger one
  bed.close();
  bed.evidence.fit.residuals << shrinking(24, 1), shrinking(4, 2), shrinking(24, 3);
  const NoiseEstimate found = bed.estimate();
  for (const char* name : {"s", "t"}) {
    EXPECT_NEAR(of(found, name).noise.absolute, 3, 1e-9) << name;
    EXPECT_EQ(of(found, name).freedom, 0) << name;
    EXPECT_EQ(of(found, name).kind, Kind::encompassing) << name;
  }
  EXPECT_NEAR(of(found, "v").freedom, 18, 1e-9);
  std::vector<std::size_t> groups(28, known_variance);
  groups.resize(52, 1);
  EXPECT_EQ(found.from.group, groups);
}

TEST(EstimatedNoise, TakesGrossRowsAsKnown) {
  HandMade bed;
  const std::vector<double> x = fakes::grid(0, 1, 26);
  for (const char* name : {"s", "t"}) bed.add(name, x, rising(x), {0.5, 0, 0}).hold_out.rows = data::RowRange{0, 2, 1};
  bed.close();
  bed.evidence.gross = {
      {"s", "y", 9, 9, 5, ""}, {"s", "y", 2, 2, 5, ""}, {"s", "z", 11, 11, 5, ""}, {"q", "y", 12, 12, 5, ""}};
  bed.evidence.fit.residuals << shrinking(24, 1), shrinking(24, 2);
  const NoiseEstimate found = bed.estimate();
  assembly::VarianceProblem problem;
  problem.columns = beside({bed.powers("s", 6), bed.powers("t", 6)});
  problem.residuals = bed.evidence.fit.residuals;  // in units of 0.5
  problem.shape = Eigen::VectorXd::Ones(48);
  problem.group.assign(24, 0);
  problem.group.resize(48, 1);
  problem.group[7] = problem.group[0] = known_variance;  // rows 9 and 2 of the file: the first two are held out
  const auto expected = restricted_variance(problem);
  EXPECT_EQ(found.from.group, problem.group);
  EXPECT_NEAR(of(found, "s").noise.absolute, 0.5 * std::sqrt(expected.variance[0]), 1e-5);
  EXPECT_NEAR(of(found, "s").freedom, expected.freedom[0], 1e-4);
  EXPECT_NEAR(of(found, "t").freedom, 18, 1e-9);
}

// Columns that differ by 1e-4 of their length are two, and so are those that differ in a curve of 1e-6 of the σ alone.
TEST(EstimatedNoise, CountsEveryColumnOfTheFit) {
  OneCurve bed(24);
  bed.add_column(rough(24, 3));
  bed.add_column(rough(24, 3) + 1e-4 * rough(24, 4));
  EXPECT_NEAR(bed.estimate().sources[0].freedom, 16, 1e-6);

  HandMade two;
  const std::vector<double> x = fakes::grid(0, 1, 24);
  two.add("s", x, rising(x), {0.5, 0, 0});
  two.add("t", x, rising(x), {5e-7, 0, 0});
  two.close();
  two.evidence.fit.residuals << shrinking(24, 1), shrinking(24, 2);
  const Eigen::VectorXd common = two.in_curve("s", rough(24, 3));
  two.add_column(common + two.in_curve("t", rough(24, 4)));
  two.add_column(common + two.in_curve("t", rough(24, 5)));
  const NoiseEstimate found = two.estimate();
  EXPECT_EQ(found.from.span.cols(), 14);
  EXPECT_NEAR(found.sources[0].freedom + found.sources[1].freedom, 48 - 14, 1e-6);
}

/// Directions orthogonal to each other and to smooth shapes of one curve of n rows.
Eigen::MatrixXd rough_directions(const HandMade& bed, Eigen::Index count) {
  const Eigen::Index n = bed.evidence.fit.residuals.size();
  Eigen::MatrixXd all = beside({bed.evidence.fit.jacobian, bed.powers("s", 6)});
  const Eigen::Index held = all.cols();
  for (Eigen::Index k = 0; k < count; ++k) all = beside({all, rough(n, 0.37 * static_cast<double>(k + 1))});
  const Eigen::MatrixXd Q = all.householderQr().householderQ() * Eigen::MatrixXd::Identity(n, held + count);
  return Q.rightCols(count);
}

TEST(EstimatedNoise, IsOutsideSignaturesThatSmoothShapesDoNotFollow) {
  OneCurve bed(40);
  bed.add_column(rough(40, 9));
  const Eigen::MatrixXd w = rough_directions(bed, 4);
  Eigen::VectorXd smooth = bed.powers("s", 6).col(1), J = bed.evidence.fit.jacobian.col(0).normalized();
  smooth -= J * J.dot(smooth);
  smooth.normalize();
  const auto leaves = [&](double length, Eigen::Index k) -> Eigen::VectorXd {
    return length * w.col(k) + std::sqrt(1 - length * length) * smooth;
  };
  // 0.3 and 0.5 of a signature are left, then 0.2; what the third would add to the first is 0.2; the last ones are
  // what a refit takes, to 5e-5 and to 1.5e-4 of their lengths.
  const std::vector<Eigen::VectorXd> signatures{leaves(0.2, 0),
                                                1000 * leaves(0.3, 1),
                                                2e-3 * (std::sqrt(0.96) * w.col(1) + 0.2 * w.col(0)),
                                                3 * leaves(0.5, 2),
                                                1e3 * (J + 5e-5 * w.col(0)),
                                                Eigen::VectorXd::Zero(40),
                                                1e-3 * (J + 1.5e-4 * w.col(3))};
  const NoiseEstimate found = bed.estimate(signatures);
  ASSERT_EQ(found.from.span.cols(), 1 + 6 + 3);
  EXPECT_NEAR(found.sources[0].freedom, 30, 1e-9);
  for (const Eigen::Index k : {1, 2, 3}) EXPECT_LT(outside(found.from.span, w.col(k)), k == 1 ? 0.21 : 1e-9) << k;
  EXPECT_GT(outside(found.from.span, w.col(0)), 0.9);
  const double left = squares_outside(found.from.span, bed.evidence.fit.residuals);
  EXPECT_NEAR(found.sources[0].noise.absolute, 0.5 * std::sqrt(left / 30), 1e-9);
  EXPECT_EQ(bed.estimate().from.span.cols(), 7);
  EXPECT_EQ(bed.estimate({signatures[3]}).from.span.cols(), 8);
}

/// Signatures of which 0.3 … 1 are left, the most by the last.
std::vector<Eigen::VectorXd> graded(const HandMade& bed, const Eigen::MatrixXd& w) {
  const Eigen::VectorXd smooth = bed.powers("s", 1).normalized();
  std::vector<Eigen::VectorXd> all;
  for (Eigen::Index k = 0; k < w.cols(); ++k) {
    const double length = 0.3 + 0.65 * static_cast<double>(k) / static_cast<double>(w.cols());
    all.push_back(length * w.col(k) + std::sqrt(1 - length * length) * smooth);
  }
  return all;
}

TEST(EstimatedNoise, TakesSignaturesUpToHalfOfTheRowsThoseOfWhichMostIsLeftFirst) {
  const OneCurve bed(25);  // six smooth shapes, and six more
  const Eigen::MatrixXd w = rough_directions(bed, 9);
  const NoiseEstimate found = bed.estimate(graded(bed, w));
  ASSERT_EQ(found.from.span.cols(), 12);
  EXPECT_NEAR(found.sources[0].freedom, 13, 1e-9);
  for (Eigen::Index k = 0; k < 9; ++k) {
    const double left = outside(found.from.span, w.col(k));
    EXPECT_TRUE(k < 3 ? left > 0.99 : left < 1e-9) << k << ": " << left;
  }
}

TEST(EstimatedNoise, TakesNoMoreThanSixtySignatures) {
  const OneCurve bed(160);
  const Eigen::MatrixXd w = rough_directions(bed, 63);
  EXPECT_EQ(bed.estimate(graded(bed, w)).from.span.cols(), 66);
}

TEST(EstimatedNoise, TakesNoSignatureWhereTheRestIsHalfOfTheRowsAlready) {
  OneCurve bed(11);  // three smooth shapes
  for (const double seed : {1, 2, 3}) bed.add_column(rough(11, seed));
  const std::vector<Eigen::VectorXd> signatures{rough(11, 4), rough(11, 5)};
  EXPECT_EQ(bed.estimate(signatures).from.span.cols(), 6);
}

}  // namespace
}  // namespace tunica::diagnosis
