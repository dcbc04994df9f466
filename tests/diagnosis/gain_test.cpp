// SPDX-License-Identifier: Apache-2.0
// Rows that were not fitted, predicted with an extension and without: everything is linear here, and solved anew.
#include "diagnosis/prospects/gain.hpp"

#include <cmath>
#include <map>

#include <Eigen/QR>
#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"
#include "numerics/distributions.hpp"

namespace tunica::diagnosis::gain_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Names = std::vector<std::string>;

/// Values between −1 and 1 that follow nothing.
Eigen::VectorXd scattered(Eigen::Index n) {
  const Eigen::ArrayXd i = Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  return (2.3 * i.square() + 1.7).sin();
}

/// a + c x² fitted, beside 0.1 x, to tests with these rows, and a mechanism with this shape that the data have three
/// times, and scatter.
struct Straight : MadeUpCauses {
  Straight(const std::vector<int>& rows, const Eigen::VectorXd& shape, const std::vector<std::string>& places,
           const std::vector<std::string>& types = {})
      : MadeUpCauses(rows, 3 * shape + scattered(shape.size())), beyond(3 * shape + scattered(shape.size())) {
    for (std::size_t t = 0; t < types.size(); ++t) experiment.tests[t].type = types[t];
    free("a", -1000, 1000);
    free("c", -1000, 1000);
    add({"m", shape, {places}});
    close();
    columns.resize(shape.size(), 3);
    columns << Eigen::VectorXd::Ones(shape.size()),
        Eigen::ArrayXd::LinSpaced(shape.size(), 0, static_cast<double>(shape.size() - 1)).square(), shape;
  }
  [[nodiscard]] std::vector<HeldOut> blocks(const std::vector<std::size_t>& needed = {2}) {
    const Single single = this->single("m");
    const std::vector<Variable> variables = single.best->extension->variables();
    return held_out_blocks(inquiry(), analysis.evidence,
                           {single.best->extension->assembly(), variables, single.best->fit, needed});
  }
  /// Errors of the rows of a block predicted by some columns, fitted to the others; and |r|² of those.
  [[nodiscard]] std::pair<Eigen::VectorXd, double> predicted(Eigen::Index width, const std::vector<Eigen::Index>& in,
                                                             const std::vector<Eigen::Index>& out) const {
    const Eigen::MatrixXd X = columns.leftCols(width)(in, Eigen::all);
    const Eigen::VectorXd y = beyond(in), fitted = X.colPivHouseholderQr().solve(y);
    return {columns.leftCols(width)(out, Eigen::all) * fitted - beyond(out), (y - X * fitted).squaredNorm()};
  }
  void expect_block(const HeldOut& block, const std::vector<Eigen::Index>& out) const {
    std::vector<Eigen::Index> in, all;
    for (Eigen::Index i = 0; i < beyond.size(); ++i) {
      all.push_back(i);
      if (std::find(out.begin(), out.end(), i) == out.end()) in.push_back(i);
    }
    const auto root = std::sqrt(static_cast<double>(out.size()));
    EXPECT_EQ(block.rows, out.size()) << block.block;
    EXPECT_NEAR(block.before, predicted(2, in, out).first.norm() / root, 1e-2 * block.before) << block.block;
    EXPECT_NEAR(block.after, predicted(3, in, out).first.norm() / root, 1e-2 * block.after) << block.block;
    const double chow = predicted(3, all, all).second - predicted(3, in, out).second;
    EXPECT_NEAR(block.p_value, numerics::chi_squared_above(chow, static_cast<double>(out.size())), 1e-2) << block.block;
    EXPECT_EQ(block.verdict, verdict_of(block.before, block.after, block.p_value));
  }

  Eigen::VectorXd beyond;
  Eigen::MatrixXd columns;
};

Names names_of(const std::vector<HeldOut>& blocks) {
  Names names;
  for (const HeldOut& block : blocks) names.push_back(block.block);
  return names;
}

Eigen::VectorXd wave(Eigen::Index n) { return Eigen::ArrayXd::LinSpaced(n, 0, 9).sin(); }

// Three tests of six, five and seven rows, at 0 … 17; beyond 70 % of its range each has its last two rows.
TEST(HeldOutBlocks, AreEveryTestAndTheEndOfTheRange) {
  Straight bed({6, 5, 7}, wave(18), {"a", "b", "c"});
  const std::vector<HeldOut> found = bed.blocks();
  ASSERT_THAT(names_of(found), ElementsAre("test a", "test b", "test c", "beyond 70 % of the range"));
  bed.expect_block(found[0], {0, 1, 2, 3, 4, 5});
  bed.expect_block(found[1], {6, 7, 8, 9, 10});
  bed.expect_block(found[2], {11, 12, 13, 14, 15, 16, 17});
  bed.expect_block(found[3], {4, 5, 9, 10, 16, 17});
}

TEST(HeldOutBlocks, AreEveryTypeOfTestThatThereAreSeveralOf) {
  Straight bed({5, 4, 6}, wave(15), {"a", "b", "c"}, {"costly_curve", "curve", "costly_curve"});
  const std::vector<HeldOut> found = bed.blocks();
  ASSERT_THAT(names_of(found), ElementsAre("test a", "test b", "test c", "beyond 70 % of the range"))
      << "four rows are too few for two parameters, when both go";
  Straight more({5, 7, 6}, wave(18), {"a", "b", "c"}, {"costly_curve", "curve", "costly_curve"});
  const std::vector<HeldOut> all = more.blocks();
  ASSERT_THAT(names_of(all),
              ElementsAre("test a", "test b", "test c", "protocol costly_curve", "beyond 70 % of the range"));
  more.expect_block(all[3], {0, 1, 2, 3, 4, 12, 13, 14, 15, 16, 17});
}

// Five rows are enough for two parameters; tests of a row each have no range.
TEST(HeldOutBlocks, LeaveMoreThanTwoRowsAParameter) {
  Straight enough({5, 5, 6}, wave(16), {"a", "b", "c"}, {"costly_curve", "curve", "costly_curve"});
  EXPECT_THAT(names_of(enough.blocks()),
              ElementsAre("test a", "test b", "test c", "protocol costly_curve", "beyond 70 % of the range"));
  Straight points({1, 1, 1, 1, 1, 1, 1}, wave(7), {"a", "b", "c", "d", "e", "f", "g"});
  const std::vector<HeldOut> found = points.blocks();
  EXPECT_THAT(names_of(found), ElementsAre("test a", "test b", "test c", "test d", "test e", "test f", "test g"));
  points.expect_block(found[2], {2});
}

TEST(HeldOutBlocks, OfOneTestAreTheEndOfItsRange) {
  Straight bed({12}, wave(12), {"a"});
  const std::vector<HeldOut> found = bed.blocks();
  ASSERT_THAT(names_of(found), ElementsAre("beyond 70 % of the range"));
  bed.expect_block(found[0], {8, 9, 10, 11});
}

// What acts in "b" alone cannot be predicted from "a"; with a twentieth of its effect there neither.
TEST(HeldOutBlocks, AreLeftOutWhereTheOthersDoNotShowTheEffect) {
  Eigen::VectorXd shape = wave(16);
  shape.head(8) *= 0.05;
  Straight little({8, 8}, shape, {"a", "b"});
  EXPECT_THAT(names_of(little.blocks()), ElementsAre("test a", "beyond 70 % of the range"));
  EXPECT_THAT(names_of(little.blocks({})), ElementsAre("test a", "test b", "beyond 70 % of the range"))
      << "where nobody needs it";
  shape = wave(16);
  shape.head(8) *= 0.15;
  EXPECT_THAT(names_of(Straight({8, 8}, shape, {"a", "b"}).blocks()),
              ElementsAre("test a", "test b", "beyond 70 % of the range"));
}

TEST(GainOfACause, IsThatOfItsFitBesideWhatNothingGains) {
  Straight bed({8, 8}, wave(16), {"a", "b"});
  Claim claim;
  claim.best = bed.single("m").best;
  claim.best_rejected = Rejected{"other", 7};
  Draws draws;
  draws.residuals = Eigen::MatrixXf::Zero(16, 50);
  draws.residuals.row(3).setConstant(2);
  bed.analysis.alarm.detector =
      std::make_shared<const Detector>(bed.analysis.hypotheses.projection, bed.analysis.hypotheses.directions, 1,
                                       Shapes{Eigen::MatrixXd(16, 0), {}}, draws);
  const Gain found = gain_of(bed.inquiry(), bed.analysis, claim);
  std::vector<Eigen::Index> all(16);
  for (Eigen::Index i = 0; i < 16; ++i) all[static_cast<std::size_t>(i)] = i;
  EXPECT_NEAR(found.before, bed.predicted(2, all, all).second, 1e-3);
  EXPECT_NEAR(found.after, bed.predicted(3, all, all).second, 1e-3);
  EXPECT_GT(found.expected_under_nothing, 0);
  EXPECT_EQ(found.expected_under_nothing, bed.analysis.alarm.detector->gain_of_nothing());
  EXPECT_EQ(found.best_rejected->id, "other");
  ASSERT_THAT(names_of(found.held_out), ElementsAre("test a", "test b", "beyond 70 % of the range"));
  bed.expect_block(found.held_out[1], {8, 9, 10, 11, 12, 13, 14, 15});
}

// Of two causes the rows have to show both amplitudes, whatever nuisance parameters the first has.
TEST(GainOfACause, NeedsRowsThatShowEveryAmplitude) {
  MadeUpCauses causes({8, 8}, wave(16) + scattered(16));
  Eigen::VectorXd second = Eigen::VectorXd::Zero(16);
  second.tail(8) = scattered(8);
  causes.add({"p", wave(16), {{"a", "b"}}, MechanismFactory::Side::both, 1, 0, {{"w", 0.2 * wave(16).reverse()}}});
  causes.add({"q", second, {{"b"}}});
  causes.free("a", -1000, 1000);
  causes.close();
  Claim claim;
  claim.best = causes.group_of({causes.direction("p"), causes.direction("q")}).refit;
  EXPECT_THAT(names_of(gain_of(causes.inquiry(), causes.analysis, claim).held_out),
              ElementsAre("test a", "beyond 70 % of the range"))
      << "q shows in b only";
}

TEST(GainOfACause, IsReportedToTheProgress) {
  Straight bed({8, 8}, wave(16), {"a", "b"});
  bed.reports.clear();
  EXPECT_THAT(bed.blocks(), ::testing::SizeIs(3));
  std::vector<double> shares;
  for (const auto& [share, stage] : bed.reports)
    if (stage.find("not fitted") != std::string::npos) shares.push_back(share);
  std::sort(shares.begin(), shares.end());
  using ::testing::DoubleNear;
  EXPECT_THAT(shares, ElementsAre(DoubleNear(0.7, 1e-9), DoubleNear(0.75, 1e-9), DoubleNear(0.8, 1e-9),
                                  DoubleNear(0.85, 1e-9)));
}

// Below 2 σ and smaller by more than 2 %; from 2 σ on, or larger by more than a fifth, and p below 0.05.
TEST(VerdictOfABlock, NeedsAnErrorThatIsSmallAndSmaller) {
  EXPECT_EQ(verdict_of(4, 1.9, 0.5), BlockVerdict::predicted);
  EXPECT_EQ(verdict_of(4, 1.9, 0.001), BlockVerdict::predicted);
  EXPECT_EQ(verdict_of(1, 0.97, 0.5), BlockVerdict::predicted);
  EXPECT_EQ(verdict_of(1, 0.99, 0.001), BlockVerdict::inconclusive);
  EXPECT_EQ(verdict_of(1, 1.19, 0.001), BlockVerdict::inconclusive);
  EXPECT_EQ(verdict_of(1, 1.21, 0.001), BlockVerdict::not_predicted);
  EXPECT_EQ(verdict_of(1, 1.21, 0.06), BlockVerdict::inconclusive) << "it may be chance";
  EXPECT_EQ(verdict_of(4, 2, 0.04), BlockVerdict::not_predicted) << "far off, though nearer than before";
  EXPECT_EQ(verdict_of(0.5, 0.61, 0.001), BlockVerdict::not_predicted);
  EXPECT_EQ(verdict_of(0.5, 0.59, 0.001), BlockVerdict::inconclusive);
  EXPECT_EQ(verdict_of(4, 2.1, 0.06), BlockVerdict::inconclusive);
}

}  // namespace
}  // namespace tunica::diagnosis::gain_test
