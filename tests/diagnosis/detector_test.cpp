// SPDX-License-Identifier: Apache-2.0
// The detector on draws that are made by hand: every p-value is that of the formulas in its header, worked out anew.
#include "diagnosis/detection/detector.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gmock/gmock.h>

#include "assembly/restricted_variance.hpp"
#include "numerics/distributions.hpp"

namespace tunica::diagnosis::detector_test {
namespace {

using ::testing::ElementsAre;
using Side = MechanismFactory::Side;

constexpr Eigen::Index rows = 8;

Eigen::VectorXd row(Eigen::Index k, double value = 1) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(rows);
  r[k] = value;
  return r;
}

Direction along(const Eigen::VectorXd& v, std::size_t candidate, Side side = Side::both, double share = 1) {
  Direction made;
  made.candidate = candidate;
  made.unit = v.normalized();
  made.length = v.norm();
  made.side = side;
  made.share = share;
  return made;
}

/// Values of row and draw.
Draws draws_of(Eigen::Index count, const std::function<double(Eigen::Index row, Eigen::Index draw)>& value) {
  Draws made;
  made.residuals.resize(rows, count);
  for (Eigen::Index b = 0; b < count; ++b)
    for (Eigen::Index i = 0; i < rows; ++i) made.residuals(i, b) = static_cast<float>(value(i, b));
  return made;
}

/// In row 0 draws of which B is 0, 0.1, 0.2 …, the largest first; 0 elsewhere.
Draws ladder(Eigen::Index count) {
  return draws_of(count, [count](Eigen::Index i, Eigen::Index b) {
    return i == 0 ? std::sqrt(0.2 * static_cast<double>(count - 1 - b)) : 0;
  });
}

/// Between −2 and 2 in every row, no two alike.
Draws mixed(Eigen::Index count) {
  return draws_of(count, [](Eigen::Index i, Eigen::Index b) {
    return 2 * std::sin(static_cast<double>(1 + b) * (1 + 0.37 * static_cast<double>(i)) + static_cast<double>(i * i));
  });
}

Shapes no_shapes() { return {Eigen::MatrixXd(rows, 0), {}}; }

Detector on_ladder(Eigen::Index count) { return {{}, {along(row(0), 0)}, 1, no_shapes(), ladder(count)}; }

/// Residuals of which B of one direction is this.
Eigen::VectorXd with_B(double B) { return row(0, std::sqrt(2 * B)); }

double chi_squared_1(double T) { return numerics::chi_squared_above(T, 1); }

TEST(DetectorOfDraws, CountsThoseThatAreAtLeastAsLarge) {
  const Detector detector = on_ladder(100);
  EXPECT_EQ(detector.test(with_B(0)).mechanisms, 1);
  EXPECT_NEAR(detector.test(with_B(5.05)).mechanisms, 0.49, 1e-12) << "5.1, 5.2 … 9.9";
  EXPECT_NEAR(detector.test(with_B(9.75)).mechanisms, 0.02, 1e-12);
}

// From the highest 2 % of the draws, or the highest of few draws, p falls as e^−B.
TEST(DetectorOfDraws, IsExponentialBeyondTheHighestTwoPercent) {
  EXPECT_NEAR(on_ladder(100).test(with_B(12)).mechanisms, 0.02 * std::exp(9.8 - 12), 1e-8);
  EXPECT_NEAR(on_ladder(98).test(with_B(12)).mechanisms, std::exp(9.7 - 12) / 98, 1e-8);
  EXPECT_NEAR(on_ladder(49).test(with_B(12)).mechanisms, std::exp(4.8 - 12) / 49, 1e-8);
}

// p is the share of the draws whose own smallest p is no larger; of the ladder those are 0.0181, 0.02, 0.03 …
TEST(DetectorOfDraws, IsCalibratedByWhatTheDrawsThemselvesSay) {
  const Detector hundred = on_ladder(100);
  EXPECT_NEAR(hundred.test(with_B(5.05)).p, 0.49, 1e-12);
  EXPECT_NEAR(hundred.test(with_B(9.75)).p, 0.02, 1e-12);
  EXPECT_NEAR(hundred.test(with_B(9.95)).p, 0.02 * std::exp(9.8 - 9.95) / 0.03 * 0.02, 1e-7);
  EXPECT_NEAR(hundred.test(with_B(12)).p, 0.02 * std::exp(9.8 - 12) / 0.03 * 0.02, 1e-8) << "a line through 0";
  EXPECT_NEAR(on_ladder(98).test(with_B(12)).p, std::exp(9.7 - 12) / 98 / (2.0 / 98) * 0.02, 1e-8);
  EXPECT_EQ(on_ladder(49).test(with_B(12)).p, 0) << "so few draws have no lowest 2 %";
}

TEST(DetectorOfDraws, KnowsWhatTheBestMechanismGainsOnAverage) {
  EXPECT_NEAR(on_ladder(100).gain_of_nothing(), 9.9, 1e-5);
  const Detector two({}, {along(row(0), 0, Side::positive), along(row(1), 1)}, 2, no_shapes(), mixed(300));
  double mean = 0;
  const Eigen::MatrixXd r = mixed(300).residuals.cast<double>();
  for (Eigen::Index b = 0; b < 300; ++b) mean += std::max(std::pow(std::max(r(0, b), 0.0), 2), r(1, b) * r(1, b)) / 300;
  EXPECT_NEAR(two.gain_of_nothing(), mean, 1e-5);
  EXPECT_EQ(Detector({}, {}, 0, no_shapes(), mixed(10)).gain_of_nothing(), 0);
}

// K of p = K P(χ²₁ > T) by the points that a tenth, a twentieth and a fiftieth of the draws reach: 18, 19, 19.6.
TEST(DetectorOfDraws, KnowHowManyHypothesesACandidateIsWorth) {
  const Detector detector = on_ladder(100);
  const double K = std::cbrt(0.1 / chi_squared_1(18) * 0.05 / chi_squared_1(19) * 0.02 / chi_squared_1(19.6));
  for (const double T : {25.0, 30.0}) EXPECT_NEAR(detector.candidate_p(0, T) / (K * chi_squared_1(T)), 1, 1e-4);
  EXPECT_EQ(detector.candidate_p(0, 1), 1) << "no more than 1";
  EXPECT_EQ(detector.candidate_p(0, 0), 1);
  EXPECT_NEAR(detector.test(row(0, 5)).by_candidate[0], detector.candidate_p(0, 25), 1e-15);

  // Four draws in a hundred on its side: the fiftieth alone has a score.
  const Draws few =
      draws_of(100, [](Eigen::Index, Eigen::Index b) { return b < 4 ? 1 + 0.5 * static_cast<double>(b) : -3; });
  const Detector rare({}, {along(row(0), 0, Side::positive)}, 1, no_shapes(), few);
  EXPECT_NEAR(rare.candidate_p(0, 9), 0.02 / chi_squared_1(4) * chi_squared_1(9), 1e-9);

  const Draws small = draws_of(100, [](Eigen::Index, Eigen::Index b) { return b < 80 ? 0 : 0.9; });
  const Detector calm({}, {along(row(0), 0)}, 1, no_shapes(), small);
  EXPECT_NEAR(calm.candidate_p(0, 9), std::cbrt(0.1 * 0.05 * 0.02) / chi_squared_1(0.81) * chi_squared_1(9), 1e-6);

  const Detector still({}, {along(row(0), 0)}, 1, no_shapes(), draws_of(100, [](auto, auto) { return 0; }));
  EXPECT_NEAR(still.candidate_p(0, 4), chi_squared_1(4), 1e-12) << "one, where the draws say nothing";
  EXPECT_NEAR(still.candidate_p(0, 0.5), chi_squared_1(0.5), 1e-12);
}

/// Two mechanisms that show and one that does not; the first in two places, one of them one-sided.
std::vector<Direction> three() {
  return {along(row(0), 0, Side::both, 0.7), along(row(1), 0, Side::positive, 0.3), along(row(2), 2)};
}

/// ln mean over the candidates that show of Σ share exp(T/2) {1, 2Φ(√T)}; for a score on the wrong side T = 0.
double B_of(const std::vector<Direction>& directions, const std::function<double(const Direction&)>& score_of) {
  std::vector<std::size_t> shown;
  double sum = 0;
  for (const Direction& one : directions) {
    if (std::find(shown.begin(), shown.end(), one.candidate) == shown.end()) shown.push_back(one.candidate);
    const double t = one.side == Side::both ? score_of(one) : std::max(score_of(one), 0.0);
    sum += one.share * std::exp(t * t / 2) * (one.side == Side::both ? 1 : std::erfc(-t / std::sqrt(2.0)));
  }
  return std::log(sum / static_cast<double>(shown.size()));
}

std::vector<double> B_of_draws(const std::vector<Direction>& directions, const Draws& draws) {
  std::vector<double> all;
  for (Eigen::Index b = 0; b < draws.residuals.cols(); ++b)
    all.push_back(
        B_of(directions, [&](const Direction& one) { return one.unit.dot(draws.residuals.col(b).cast<double>()); }));
  return all;
}

double share_at_least(const std::vector<double>& all, double value) {
  return static_cast<double>(std::count_if(all.begin(), all.end(), [&](double one) { return one >= value; })) /
         static_cast<double>(all.size());
}

TEST(DetectorOfDraws, WeighsAllMechanismsAgainstNothing) {
  const Draws draws = mixed(200);
  const Detector detector({}, three(), 3, no_shapes(), draws);
  const std::vector<double> all = B_of_draws(three(), draws);
  for (const double size : {0.3, 0.7, 1.1, 1.5, 1.7}) {
    for (const double sign : {1.0, -1.0}) {
      const Eigen::VectorXd r = row(0, 0.6 * size) + row(1, sign * size) + row(2, 0.9 * size);
      const double B = B_of(three(), [&](const Direction& one) { return one.unit.dot(r); });
      EXPECT_NEAR(detector.test(r).mechanisms, share_at_least(all, B), 1e-12) << size << " " << sign;
      EXPECT_EQ(detector.test(r).by_candidate[1], 1) << "it leaves no trace";
    }
  }
}

// In single precision e^T/2 of the draws would have no end: beyond e^80 it is taken for that.
TEST(DetectorOfDraws, TakesNoDrawForMoreThanSinglePrecisionHolds) {
  const Draws one = draws_of(49, [](Eigen::Index i, Eigen::Index b) { return i == 0 && b == 0 ? 15 : 0.1; });
  const Detector both({}, {along(row(0), 0)}, 1, no_shapes(), one);
  EXPECT_NEAR(both.test(with_B(80.5)).mechanisms, std::exp(80 - 80.5) / 49, 1e-6);
  const Detector upwards({}, {along(row(0), 0, Side::positive)}, 1, no_shapes(), one);
  EXPECT_NEAR(upwards.test(with_B(80.5)).mechanisms, std::exp(80 - 80.5) / 49, 1e-6);
}

TEST(DetectorOfDraws, NamesTheDirectionWithTheLargestScore) {
  const Detector detector({}, {along(row(0), 1), along(row(1), 1), along(row(2), 0, Side::positive)}, 3, no_shapes(),
                          mixed(100));
  EXPECT_THAT(detector.test(row(0, 1) + row(1, 2)).direction, ElementsAre(2, 1, 3)) << "3: none";
  EXPECT_THAT(detector.test(row(0, -2) + row(1, 1) - row(2)).direction, ElementsAre(2, 0, 3));
  EXPECT_EQ(detector.test(row(0, 1) + row(1, 1 + 1e-12)).direction[1], 0u) << "the first of what is equal";
  EXPECT_EQ(detector.test(row(0, 1) + row(1, 1 + 1e-6)).direction[1], 1u);
  EXPECT_EQ(detector.test(row(5)).direction[1], 0u) << "also where the largest is 0";
}

/// A refit absorbs row 6. Shapes of three curves: rows 3 and 4, the second of them 0.0015 beside the first; a shape of
/// which 1.5 % is left, in row 7; and one of which half a per cent is left.
struct Smooth {
  Smooth() {
    shapes.columns.resize(rows, 4);
    shapes.columns << row(3), row(3) + 0.0015 * row(4), row(6) + 0.015 * row(7), 10 * row(6) + 0.05 * row(5);
    shapes.curve = {0, 0, 1, 2};
  }
  [[nodiscard]] static double Q_of(const Eigen::VectorXd& r) { return r[3] * r[3] + r[4] * r[4] + r[7] * r[7]; }

  Projection projection{Eigen::MatrixXd(row(6))};
  Shapes shapes;
  Draws draws = mixed(200);
};

TEST(DetectorOfDraws, SeesSmoothShapesThatARefitDoesNotAbsorb) {
  const Smooth set;
  const Detector detector(set.projection, {}, 0, set.shapes, set.draws);
  double scale = 0;
  for (const auto draw : set.draws.residuals.colwise()) scale += Smooth::Q_of(draw.cast<double>()) / 200 / 3;
  EXPECT_GT(std::abs(scale - 1), 0.2) << "the draws say how large Q is";
  for (const double size : {0.2, 2.0}) {
    const Eigen::VectorXd r = size * (row(3) + 2 * row(4) + 0.5 * row(5) + 0.7 * row(7));
    const Detection found = detector.test(r);
    EXPECT_NEAR(found.Q, Smooth::Q_of(r), 1e-9);
    EXPECT_NEAR(found.smooth, numerics::chi_squared_above(found.Q / scale, 3), 1e-5);
    ASSERT_EQ(found.by_curve.size(), 3u);
    EXPECT_NEAR(found.by_curve[0], numerics::chi_squared_above(5 * size * size / scale, 2), 1e-5);
    EXPECT_NEAR(found.by_curve[1], numerics::chi_squared_above(0.49 * size * size / scale, 1), 1e-5);
    EXPECT_EQ(found.by_curve[2], 1) << "nothing is left of its shape";
  }
  EXPECT_EQ(detector.test(row(0)).smooth, 1);
  EXPECT_EQ(on_ladder(100).test(row(1)).smooth, 1) << "without shapes";
  EXPECT_TRUE(on_ladder(100).test(row(1)).by_curve.empty());
}

TEST(DetectorOfDraws, KnowsOneShape) {
  const Draws twos = draws_of(100, [](Eigen::Index, Eigen::Index) { return 2; });
  const Detector scaled({}, {}, 0, {Eigen::MatrixXd(row(3)), {0}}, twos);
  EXPECT_NEAR(scaled.test(row(3, 2)).Q, 4, 1e-12);
  EXPECT_NEAR(scaled.test(row(3, 2)).smooth, chi_squared_1(1), 1e-6);
  EXPECT_THAT(scaled.test(row(3, 2)).by_curve, ElementsAre(::testing::DoubleNear(chi_squared_1(1), 1e-6)));
}

// The smaller of p_B and 4 p_Q, among those of the draws.
TEST(DetectorOfDraws, WeighsBothTests) {
  const Smooth set;
  const Detector detector(set.projection, three(), 3, set.shapes, set.draws);
  std::vector<double> smallest;
  for (const auto draw : set.draws.residuals.colwise()) {
    const Detection own = detector.test(draw.cast<double>());
    smallest.push_back(std::min(own.mechanisms, 4 * own.smooth));
  }
  std::size_t smooth_decides = 0;
  for (const double size : {0.2, 0.6, 1.2, 1.5, 1.7}) {
    for (const double of_shapes : {0.1, 1.3}) {
      const Detection found =
          detector.test(size * (row(0) + 0.5 * row(1) + 0.8 * row(2) + of_shapes * (row(3) - row(4) + 0.9 * row(7))));
      const double least = std::min(found.mechanisms, 4 * found.smooth);
      smooth_decides += least < found.mechanisms ? 1 : 0;
      ASSERT_GT(found.p, 0.02) << "no straight line";
      EXPECT_NEAR(found.p, 1 - share_at_least(smallest, least * (1 + 1e-6)), 0.0051);
    }
  }
  EXPECT_GE(smooth_decides, 2u);
  EXPECT_LE(smooth_decides, 8u);
}

/// Two curves whose σ every draw has estimated, and a row of known σ. A draw holds σ = 1 noise over its own σ̂.
struct Estimated {
  explicit Estimated(Eigen::Index count) : draws(mixed(count)) {
    draws.group = {0, 0, 1, 1, 0, 1, 0, assembly::known_variance};
    draws.precision.resize(2, count);
    for (Eigen::Index b = 0; b < count; ++b)
      draws.precision.col(b) << static_cast<float>(1.3 + std::sin(2.1 * static_cast<double>(b))),
          static_cast<float>(1.1 + 0.8 * std::cos(1.3 * static_cast<double>(b)));
    for (Eigen::Index b = 0; b < count; ++b)
      draws.residuals.col(b).array() *= draws.precision_of_rows(b).cast<float>().array().sqrt();
  }
  /// What a refit leaves of the noise.
  [[nodiscard]] Eigen::VectorXd left(Eigen::Index b) const {
    const Eigen::VectorXd noise =
        draws.residuals.col(b).cast<double>().cwiseQuotient(draws.precision_of_rows(b).cwiseSqrt());
    return projection.off(noise);
  }
  /// Σ u w r/√(Σ u² w)
  [[nodiscard]] double score_of(const Direction& one, Eigen::Index b) const {
    const Eigen::VectorXd w = draws.precision_of_rows(b);
    return one.unit.cwiseProduct(w).dot(left(b)) / std::sqrt(one.unit.cwiseAbs2().dot(w));
  }

  Projection projection{Eigen::MatrixXd(Eigen::VectorXd::Ones(rows))};
  std::vector<Direction> directions{along(projection.off(row(0) + 2 * row(2)), 0),
                                    along(projection.off(row(3) - row(1)), 1, Side::positive),
                                    along(projection.off(row(7)), 1)};
  Draws draws;
};

TEST(DetectorOfDraws, WeighsADrawByTheNoiseThatItHasEstimated) {
  for (const Eigen::Index count : {80, 620}) {  // they are taken 500 at a time
    const Estimated set(count);
    const Shapes shape{Eigen::MatrixXd(row(4) - row(5)), {0}};
    const Detector detector(set.projection, set.directions, 2, shape, set.draws);
    std::vector<double> all;
    double gain = 0, Q = 0;
    for (Eigen::Index b = 0; b < count; ++b) {
      const auto score = [&](const Direction& one) { return set.score_of(one, b); };
      all.push_back(B_of(set.directions, score));
      const double upwards = std::max(score(set.directions[1]), 0.0);
      gain += std::pow(std::max({std::abs(score(set.directions[0])), upwards, std::abs(score(set.directions[2]))}), 2);
      const Eigen::VectorXd whitened = set.left(b).cwiseProduct(set.draws.precision_of_rows(b).cwiseSqrt());
      Q += std::pow(whitened[4] - whitened[5], 2) / 2;
    }
    const auto size = static_cast<double>(count);
    EXPECT_NEAR(detector.gain_of_nothing(), gain / size, 1e-5);
    EXPECT_NEAR(detector.test(row(4, 2)).smooth, chi_squared_1(2 / (Q / size)), 1e-5);
    for (const double B : {0.2, 0.4, 0.6, 0.8, 1.0}) {
      const double t = std::sqrt(2 * std::log(2 * std::exp(B) - 2));  // the others say 1
      if (std::isnan(t)) continue;
      const Eigen::VectorXd r = t * set.directions[0].unit;
      const double own = B_of(set.directions, [&](const Direction& one) { return one.unit.dot(r); });
      EXPECT_NEAR(detector.test(r).mechanisms, share_at_least(all, own), 1e-9) << B;
    }
  }
}

TEST(DetectorOfDraws, WeighsResidualsByTheNoiseThatTheyHaveEstimated) {
  const Estimated set(80);
  const Shapes shape{Eigen::MatrixXd(row(4) - row(5)), {0}};
  const Detector detector(set.projection, set.directions, 2, shape, set.draws);
  for (const double sign : {1.0, -1.0}) {
    const Eigen::VectorXd r = sign * set.left(3), w = set.draws.precision_of_rows(3);
    const Detection found = detector.test(r, w);
    const auto score = [&](std::size_t k) { return sign * set.score_of(set.directions[k], 3); };
    const double T_upwards = std::pow(std::max(score(1), 0.0), 2), T_both = score(2) * score(2);
    EXPECT_NEAR(found.by_candidate[0], detector.candidate_p(0, score(0) * score(0)), 1e-9);
    EXPECT_NEAR(found.by_candidate[1], detector.candidate_p(1, std::max(T_upwards, T_both)), 1e-9);
    EXPECT_EQ(found.direction[1], T_both > T_upwards ? 2u : 1u);
    const Eigen::VectorXd whitened = r.cwiseProduct(w.cwiseSqrt());
    EXPECT_NEAR(found.Q, std::pow(whitened[4] - whitened[5], 2) / 2, 1e-9);
  }
  // A score that is small, and one on the side that the mechanism cannot go to.
  const Detector one({}, {along(row(3), 0, Side::positive)}, 1, no_shapes(),
                     draws_of(100, [](auto, auto) { return 0; }));
  EXPECT_NEAR(one.test(row(3, 0.5), Eigen::VectorXd::Constant(rows, 4)).by_candidate[0], chi_squared_1(1), 1e-12);
  EXPECT_NEAR(one.test(row(3, 0.2), Eigen::VectorXd::Constant(rows, 4)).by_candidate[0], chi_squared_1(0.16), 1e-12);
  EXPECT_EQ(one.test(row(3, -0.5), Eigen::VectorXd::Constant(rows, 4)).by_candidate[0], 1);
}

// e^B is the mean over two candidates, 1 for one that says nothing: a place with the share s has T with
// 2 e^B = 2 − s + s e^{T/2}.
// The smallest p of 128 draws are 2/128 e^−0.1, 2/128, 3/128 …: at 5 % the seventh has to be reached, for which B is
// above that of the draw with the eighth.
TEST(DetectorOfDraws, KnowsTheScoreThatRaisesTheAlarm) {
  const auto with_shares = [](double share, double of_row, const Draws& draws) {
    std::vector<Direction> all{along(row(1), 0, Side::both, 0.001), along(row(0), 1, Side::both, share),
                               along(row(2), 1, Side::both, of_row)};
    all[2].row = true;
    return Detector({}, all, 3, no_shapes(), draws);  // the third leaves no trace
  };
  // B of a draw of T/2 is ln ((0.001 + e^{T/2} share + share of rows)/2).
  const auto B_at = [](double half_T, double share, double of_row) {
    return std::log((0.001 + share * std::exp(half_T) + of_row) / 2);
  };
  for (const auto& [share, of_row] : {std::pair{1.0, 0.0}, std::pair{0.3, 0.2}}) {
    const Detector detector = with_shares(share, of_row, ladder(128));
    EXPECT_NEAR(detector.threshold(1, 0.05), 2 * std::log1p(2 * std::expm1(B_at(12.0, share, of_row)) / share), 1e-4);
    EXPECT_NEAR(detector.threshold(1, 0.2), 2 * std::log1p(2 * std::expm1(B_at(10.1, share, of_row)) / share), 1e-4);
    EXPECT_NEAR(detector.threshold(0, 0.05), 2 * std::log1p(2 * std::expm1(B_at(12.0, share, of_row)) / 0.001), 1e-4)
        << "of the other";
  }
}

// B of the ladder from 0 to 1.27. What a place with a thousandth of the prior has to show is 2 ln (1 + 1000 (e^B − 1)).
TEST(DetectorOfDraws, KnowsThatASmallScoreIsEnoughWhereDrawsAreSmall) {
  const Draws draws = draws_of(
      128, [](Eigen::Index i, Eigen::Index b) { return i == 0 ? std::sqrt(0.02 * static_cast<double>(b)) : 0; });
  const Detector detector({}, {along(row(0), 0), along(row(1), 0, Side::both, 0.001)}, 1, no_shapes(), draws);
  const double B = std::log(std::exp(0.94) + 0.001);
  EXPECT_NEAR(detector.threshold(0, 0.25), 2 * std::log1p(1000 * std::expm1(B)), 1e-3);
  const Detector still({}, {along(row(0), 0)}, 1, no_shapes(), draws_of(100, [](auto, auto) { return 0; }));
  EXPECT_NEAR(still.threshold(0, 0.05), 0, 1e-12) << "where nothing shows, anything does";
}

// One draw of a hundred is far beyond the others: no p below a millionth is asked for.
TEST(DetectorOfDraws, AsksForNoLessThanAMillionth) {
  const Draws draws = draws_of(100, [](Eigen::Index i, Eigen::Index b) {
    return i != 0 ? 0 : b == 99 ? 10 : std::sqrt(0.02 * static_cast<double>(b));
  });
  const Detector detector({}, {along(row(0), 0)}, 1, no_shapes(), draws);
  EXPECT_NEAR(detector.threshold(0, 0.001), 2 * (0.98 + std::log(0.02 / 1e-6)), 1e-4);
}

}  // namespace
}  // namespace tunica::diagnosis::detector_test
