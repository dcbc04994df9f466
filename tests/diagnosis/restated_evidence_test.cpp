// SPDX-License-Identifier: Apache-2.0
// The evidence after its noise was estimated.
#include <gmock/gmock.h>

#include "diagnosis/evidence/base_fit.hpp"
#include "diagnosis/hand_made.hpp"
#include "execution/folder.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(WhitenedDeviations, AreThoseOfTheRowsThatAFitTakesAndOneForPriors) {
  HandMade bed;
  const std::vector<double> x{0, 1, 2, 3};
  auto& entry = bed.add_test("s", x, {1, 2, 3, 4}, true);
  entry.data.noise = {{"y", {0.5, 0, 0}}, {"z", {3, 0.1, 0}}};
  entry.data.noise[1].second.gross = {2};
  entry.hold_out.rows = data::RowRange{0, 1, 1};
  bed.add("t", x, {8, 6, 4, 3}, {0, 0.5, 0});
  bed.parameter("a").prior = experiment::Prior{1, 0.5};
  bed.close();
  const Eigen::VectorXd sd = whitened_deviations(bed.evidence);
  Eigen::VectorXd expected(11);
  expected << 0.5, 0.5, 0.5, std::hypot(3, 2), std::hypot(3, 3), std::hypot(3, 4), 4, 3, 2, 1.5, 1;
  ASSERT_EQ(sd.size(), 11);
  EXPECT_LT((sd - expected).norm(), 1e-12) << sd.transpose();
}

/// y = 2 + 3x + 0.5x² and errors, in two tests; row 4 of the first is 50 kPa off.
struct Parabolas : HandMade {
  Parabolas() {
    const auto y = [](double seed) {
      return [seed](double at) { return 2 + 3 * at + 0.5 * at * at + 0.2 * std::sin(30 * at + seed); };
    };
    std::vector<double> values = fakes::map(x, y(1));
    values[4] += 50;
    add("s", x, values, {0.1, 0, 0});
    add("t", x, fakes::map(x, y(2)), {0.2, 0, 0});
    close();
    evidence.gross = {{"s", "y", 4, 4, 9, ""}};
    evidence.fit.free = {1, 1, 0};
    evidence.fit.residuals.setOnes(24);
    estimate.sources = evidence.noise;
    for (NoiseSource& one : estimate.sources) {
      one.noise.absolute = one.test == "s" ? 0.4 : 0.1;
      one.freedom = 17;
      one.kind = NoiseSource::Kind::encompassing;
    }
    estimate.from.group.assign(24, 1);
    estimate.from.moderation = 7;
    estimate.from.span = Eigen::MatrixXd(24, 2);
    estimate.from.span << rough(24, 1), rough(24, 2);
  }
  Evidence stated_again() {
    const Request request;
    const Progress silence;
    const Inquiry inquiry{experiment, request, shelf, silence};
    return restated(inquiry, evidence, estimate);
  }
  const std::vector<double> x = fakes::grid(0, 3, 12);
  NoiseEstimate estimate;
};

TEST(RestatedEvidence, IsFittedUnderTheNewNoiseWithoutGrossRows) {
  Parabolas bed;
  const Evidence found = bed.stated_again();
  // The weighted straight-line problem of a, b and c, row 4 of "s" left out.
  Eigen::MatrixXd X(24, 3);
  Eigen::VectorXd y(24);
  for (Eigen::Index i = 0; i < 24; ++i) {
    const auto row = static_cast<std::size_t>(i % 12);
    const double at = bed.x[row], weight = i == 4 ? 0 : i < 12 ? 1 / 0.4 : 1 / 0.1;
    X.row(i) << weight, weight * at, weight * at * at;
    y[i] = weight * bed.evidence.base->layout().channels[i < 12 ? 0 : 1].measured[row];
  }
  const Eigen::VectorXd best = X.colPivHouseholderQr().solve(y);
  ASSERT_EQ(found.fit.free.size(), 3u);
  for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(found.fit.free[j], best[static_cast<Eigen::Index>(j)], 2e-3) << j;
  EXPECT_NEAR(found.fit.residuals[20] * 0.1, X.row(20).dot(best) * 0.1 - y[20] * 0.1, 2e-3);
}

TEST(RestatedEvidence, SaysTheNewNoiseEverywhere) {
  Parabolas bed;
  const Evidence found = bed.stated_again();
  for (const std::size_t k : {0, 1}) {
    const double sd = k == 0 ? 0.4 : 0.1;
    EXPECT_EQ(found.noise[k].noise.absolute, sd);
    EXPECT_EQ(found.noise[k].freedom, 17);
    EXPECT_EQ(found.curves[k].noise.noise.absolute, sd);
    EXPECT_EQ(found.curves[k].noise.kind, NoiseSource::Kind::encompassing);
    ASSERT_EQ(found.experiment.tests[k].data.noise.size(), 1u);
    EXPECT_EQ(found.experiment.tests[k].data.noise[0].second.absolute, sd);
    EXPECT_EQ(found.base->layout().channels[k].noise->absolute, sd);
  }
  EXPECT_THAT(found.experiment.tests[0].data.noise[0].second.gross, ElementsAre(4u));
  EXPECT_TRUE(found.experiment.tests[1].data.noise[0].second.gross.empty());
  EXPECT_EQ(found.gross.size(), 1u);
}

TEST(RestatedEvidence, KeepsWhatItsNoiseIsFromInTheNewRows) {
  Parabolas bed;
  const Evidence found = bed.stated_again();
  EXPECT_EQ(found.estimated.group, bed.estimate.from.group);
  EXPECT_EQ(found.estimated.moderation, 7);
  const Eigen::MatrixXd& span = found.estimated.span;
  ASSERT_EQ(span.cols(), 2);
  EXPECT_LT((span.transpose() * span - Eigen::MatrixXd::Identity(2, 2)).norm(), 1e-12);
  // Rows that were divided by 0.1 are now divided by 0.4, the others by 0.1 instead of 0.2.
  Eigen::MatrixXd rows = bed.estimate.from.span;
  rows.topRows(12) *= 0.1 / 0.4;
  rows.bottomRows(12) *= 0.2 / 0.1;
  for (Eigen::Index k = 0; k < 2; ++k) EXPECT_LT(outside(span, rows.col(k)), 1e-12);
}

// The σ of "t" becomes a million times as large; columns that differ there alone are two all the same.
TEST(RestatedEvidence, KeepsColumnsThatDifferWhereTheNoiseIsLargeNow) {
  Parabolas bed;
  bed.estimate.sources[0].noise.absolute = 0.1;
  bed.estimate.sources[1].noise.absolute = 2e5;
  bed.estimate.from.span.col(1).head(12) = bed.estimate.from.span.col(0).head(12);
  EXPECT_EQ(bed.stated_again().estimated.span.cols(), 2);
}

TEST(RestatedEvidence, TakesTheShareOfTheNoiseOfThePrediction) {
  Parabolas bed;
  bed.estimate.sources[1].noise.relative = 0.1;
  const Evidence found = bed.stated_again();
  EXPECT_TRUE(found.experiment.tests[0].data.noise[0].second.level.empty());
  EXPECT_EQ(found.experiment.tests[1].data.noise[0].second.level.size(), 12u);
  EXPECT_EQ(found.base->layout().channels[1].noise->level.size(), 12u);
  // The fit is one of that: nothing is left to gain, with residuals by the noise of the base.
  const auto& channel = found.base->layout().channels[1];
  for (std::size_t i = 0; i < 12; ++i) {
    const double at = bed.x[i], sd = std::hypot(0.1, 0.1 * channel.noise->level[i]);
    const double predicted = found.fit.free[0] + found.fit.free[1] * at + found.fit.free[2] * at * at;
    EXPECT_NEAR(found.fit.residuals[12 + static_cast<Eigen::Index>(i)], (predicted - channel.measured[i]) / sd, 1e-9);
  }
}

TEST(RestatedEvidence, IsOfTheTestsOfItsRun) {
  Parabolas bed;
  bed.add("other", bed.x, bed.x, {1, 0, 0});  // of no run
  bed.run.tests = {"s", "t"};
  bed.evidence.experiment = bed.experiment;
  EXPECT_EQ(bed.stated_again().base->layout().channels.size(), 2u);
}

TEST(RestatedEvidence, TellsWhyTheModelCannotBeEvaluated) {
  Parabolas bed;
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("a torn strip"); });
  EXPECT_THAT(trial::message_of<BaseFitFailure>([&] { bed.stated_again(); }),
              HasSubstr("diagnosis: the base model cannot be evaluated where it was fitted: "));
  EXPECT_THAT(trial::message_of<BaseFitFailure>([&] { bed.stated_again(); }), HasSubstr("a torn strip"));
}

}  // namespace
}  // namespace tunica::diagnosis
