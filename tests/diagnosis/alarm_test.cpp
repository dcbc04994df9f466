// SPDX-License-Identifier: Apache-2.0
// The alarm: what refits of simulated data say beside the linear calibration, and up to which noise it stands.
#include "diagnosis/detection/alarm.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "diagnosis/detection/noise_draws.hpp"
#include "diagnosis/detection/refit_draws.hpp"
#include "diagnosis/made_up_causes.hpp"
#include "tunica/random.hpp"

namespace tunica::diagnosis::alarm_test {
namespace {

/// Alternating, so no smooth shape detects it.
Eigen::VectorXd rough(double height) {
  Eigen::VectorXd shape(12);
  for (Eigen::Index i = 0; i < 12; ++i) shape[i] = i % 2 == 0 ? height : -height;
  return shape;
}

/// Twelve rows with noise 1 and something rough beyond the base, whose mechanism is known; a line is fitted.
struct Rows : MadeUpCauses {
  explicit Rows(double height) : MadeUpCauses({12}, rough(height)) {
    add({"m", rough(1)});
    free("a", -100, 100);
    close();
    request.quick = false;
    request.seed = 3;
  }
  [[nodiscard]] Alarm alarm() const { return alarm_of(inquiry(), analysis.evidence, analysis.hypotheses); }
  /// Of draws, taken as worse from this p on.
  [[nodiscard]] double p_of_refits(double p, std::size_t draws) const {
    Detection measured;
    measured.p = p;
    return p_from_refits(inquiry(), analysis.evidence, *analysis.alarm.detector, measured, draws);
  }
};

TEST(RefitsOfSimulatedData, CountWhatLooksWorse) {
  Rows rows(0);
  rows.calibrate_by_noise();
  EXPECT_EQ(rows.p_of_refits(2, 19), 1) << "all do: (1 + 19)/(19 + 1)";
  EXPECT_EQ(rows.p_of_refits(-1, 19), 1. / 20) << "none does";
  EXPECT_EQ(rows.reports.size(), 38u) << "once a draw";
  std::set<double> shares;
  for (const auto& [share, stage] : rows.reports) {
    EXPECT_EQ(stage, "refits of simulated data");
    shares.insert(share);
  }
  EXPECT_EQ(shares.size(), 19u);
  EXPECT_NEAR(*shares.begin(), 0.2 + 0.2 / 19, 1e-12);
  EXPECT_NEAR(*shares.rbegin(), 0.4, 1e-12);
}

/// The model is linear: a refit takes its part of the noise off, and what is left is the draw itself, less that.
TEST(RefitsOfSimulatedData, AreThoseOfTheDraws) {
  Rows rows(0);
  rows.calibrate_by_noise();
  constexpr std::size_t draws = 60;
  const Evidence& evidence = rows.analysis.evidence;
  const Draws noise = noise_draws(evidence, draws, derive_seed(rows.request.seed, "refits under nothing"));
  const Projection projection(interior(evidence.fit));
  std::vector<double> ps;
  for (std::size_t b = 0; b < draws; ++b)
    ps.push_back(rows.analysis.alarm.detector
                     ->test(-projection.off(noise.residuals.col(static_cast<Eigen::Index>(b)).cast<double>()))
                     .p);
  for (const double p : {0.1, 0.3, 0.6}) {
    const auto worse = std::count_if(ps.begin(), ps.end(), [p](double one) { return one <= p; });
    EXPECT_GT(worse, 0);
    EXPECT_NEAR(rows.p_of_refits(p, draws), (1. + static_cast<double>(worse)) / (draws + 1.), 1e-12) << p;
  }
}

/// A draw that cannot be fitted is no evidence against the measured data.
TEST(RefitsOfSimulatedData, CountAsWorseWhereTheyFail) {
  const Rows rows(0);
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("it tears"); });
  EXPECT_EQ(rows.p_of_refits(-1, 19), 1);
  fakes::set_behaviour({});
}

TEST(Alarm, IsSilentWhereNothingIsLeft) {
  const Rows rows(0);
  const Alarm alarm = rows.alarm();
  EXPECT_FALSE(alarm.raised);
  EXPECT_EQ(alarm.detection.p, 1);
  EXPECT_EQ(alarm.p_refits, 1) << "no draw has less";
  EXPECT_EQ(alarm.factor, std::nullopt);
}

TEST(Alarm, IsNotRefinedWhereItIsQuick) {
  Rows rows(0);
  rows.request.quick = true;
  EXPECT_EQ(rows.alarm().p_refits, std::nullopt);
  EXPECT_THAT(rows.reports, ::testing::IsEmpty());
  rows.request.quick = false;
  EXPECT_NE(rows.alarm().p_refits, std::nullopt);
  EXPECT_THAT(rows.reports, ::testing::Contains(std::pair<double, std::string>(0.2, "refits of simulated data")));
}

/// 199 refits cannot tell p below 1/200; the linear draws can, to a tenth of it.
TEST(Alarm, TrustsTheLinearDrawsTenfoldBelowTheRefits) {
  const Alarm far = Rows(8).alarm();
  EXPECT_TRUE(far.raised);
  EXPECT_LT(far.detection.p, 1e-4);
  EXPECT_NEAR(*far.p_refits, 0.1 / 199, 1e-12);
  EXPECT_EQ(far.p(), *far.p_refits);
  // In between the linear draws say it. At heights of 1 the score is 12, at 1.3 it is 20.
  bool between = false;
  for (const double height : {1.05, 1.1, 1.15, 1.2, 1.25}) {
    const Alarm near = Rows(height).alarm();
    if (near.detection.p >= 1. / 200 || near.detection.p <= 0.1 / 199 || *near.p_refits >= 1.5 / 200) continue;
    between = true;
    EXPECT_EQ(*near.p_refits, near.detection.p) << height;
  }
  EXPECT_TRUE(between);
  // Where refits were worse they decide.
  const Alarm little = Rows(0.5).alarm();
  EXPECT_GT(*little.p_refits, 1.5 / 200);
  EXPECT_NEAR(*little.p_refits * 200, std::round(*little.p_refits * 200), 1e-9);
}

TEST(Alarm, StandsUpToANoiseThatIsTold) {
  const Rows rows(4);
  const Alarm alarm = rows.alarm();
  ASSERT_TRUE(alarm.factor);
  const Eigen::VectorXd r = -rows.analysis.evidence.fit.residuals;
  const double alpha = rows.request.alpha, factor = *alarm.factor;
  EXPECT_GT(factor, 1.05);
  EXPECT_LE(alarm.detector->test(r / factor).p, alpha);
  EXPECT_GT(alarm.detector->test(r / (1.05 * factor)).p, alpha) << "in steps of a twentieth";
  // Of what is very far out no more is asked than twenty times.
  const double most = *Rows(400).alarm().factor;
  EXPECT_LT(most, 20);
  EXPECT_GT(most, 20 / 1.05 / 1.0001);
}

}  // namespace
}  // namespace tunica::diagnosis::alarm_test
