// SPDX-License-Identifier: Apache-2.0
// Noise of simulated data that has the uncertainty of its own estimate.
#include "diagnosis/detection/noise_draws.hpp"

#include <cmath>
#include <random>

#include <boost/math/special_functions/trigamma.hpp>
#include <gtest/gtest.h>

#include "assembly/restricted_variance.hpp"
#include "diagnosis/evidence/moderation.hpp"

namespace tunica::diagnosis {
namespace {

constexpr std::size_t draw_count = 4000;
constexpr Eigen::Index channel_count = 8, rows_each = 6;

/// Channels of which the mean is fitted, and the noise estimated from the rest: five degrees of freedom each.
Evidence with_estimated_noise(double moderation) {
  Evidence evidence;
  evidence.fit.residuals = Eigen::VectorXd::Zero(channel_count * rows_each);
  evidence.estimated.span = Eigen::MatrixXd::Zero(channel_count * rows_each, channel_count);
  for (Eigen::Index g = 0; g < channel_count; ++g) {
    evidence.estimated.span.col(g)
        .segment(g * rows_each, rows_each)
        .setConstant(1 / std::sqrt(static_cast<double>(rows_each)));
    evidence.estimated.group.insert(evidence.estimated.group.end(), rows_each, static_cast<std::size_t>(g));
  }
  evidence.estimated.moderation = moderation;
  return evidence;
}

/// Of ln (σ/σ̂)² over all channels and draws.
double variance_of_log_precision(const Draws& found) {
  const Eigen::ArrayXXd log = found.precision.cast<double>().array().log();
  return (log - log.mean()).square().mean();
}

// ln of χ²_5/5 has the variance ψ′(5/2) = 0.490. Seed 1; the variance of 32 000 of them has a standard deviation of
// about 0.0058: of a logarithm of χ²_5 the fourth moment is below four squared variances. Four of them: 6e-5.
TEST(NoiseDraws, HaveTheUncertaintyOfWhatTheirRowsSay) {
  const Draws found = noise_draws(with_estimated_noise(0), draw_count, 1);
  ASSERT_EQ(found.precision.rows(), channel_count);
  EXPECT_NEAR(variance_of_log_precision(found), boost::math::trigamma(2.5), 4 * 0.0058);
}

// What is outside the span has by construction Σ e² = ν in every draw and channel.
TEST(NoiseDraws, AreAsLargeAsTheirEstimateSays) {
  const Draws found = noise_draws(with_estimated_noise(0), 100, 1);
  for (const auto draw : found.residuals.colwise())
    for (Eigen::Index g = 0; g < channel_count; ++g) {
      const Eigen::ArrayXf rows = draw.segment(g * rows_each, rows_each);
      EXPECT_NEAR((rows - rows.mean()).square().sum(), 5, 1e-4);
    }
}

/// Mean over draws of the square of ln (σ/σ̂)² in a channel, and the standard deviation of that mean.
struct MeanSquare {
  double value, sd;
  explicit MeanSquare(const Eigen::ArrayXd& squares)
      : value(squares.mean()), sd(std::sqrt((squares - value).square().mean() / static_cast<double>(squares.size()))) {}
};

// What the header says, drawn here: with d degrees of freedom of the other channels the true variance is
// V = 1/(χ²_d/d) and the channel's own squares are V χ²_5. The channels together say s_b with d_b (moderation_of), and
// the estimate is (d_b s_b + V χ²_5)/(d_b + 5). Seeds 1 and 2; four standard deviations of the difference: 6e-5.
TEST(NoiseDraws, LearnFromTheOtherChannelsWhereTheEstimateDid) {
  const Draws found = noise_draws(with_estimated_noise(20), draw_count, 1);
  const MeanSquare drawn(found.precision.row(0).transpose().cast<double>().array().log().square());
  std::mt19937_64 generator(2);
  std::chi_squared_distribution<double> of_others(20), own(5);
  Eigen::ArrayXd expected(draw_count);
  for (double& square : expected) {
    std::vector<double> V(channel_count), ratios(channel_count);
    for (std::size_t g = 0; g < V.size(); ++g) {
      V[g] = 20 / of_others(generator);
      ratios[g] = V[g] * own(generator) / 5;
    }
    const Moderation others = moderation_of(ratios, std::vector<double>(channel_count, 5));
    const double estimate = (others.freedom * others.ratio + 5 * ratios[0]) / (others.freedom + 5);
    square = std::pow(std::log(V[0] / estimate), 2);
  }
  const MeanSquare known(expected);
  EXPECT_NEAR(drawn.value, known.value, 4 * std::hypot(drawn.sd, known.sd));
  EXPECT_LT(known.value + 10 * known.sd, boost::math::trigamma(2.5)) << "it is worth while";
}

// Rows of stated noise are standard normal: the mean of 24 000 squares has a standard deviation of √(2/24000).
TEST(NoiseDraws, LeaveStatedNoiseAlone) {
  Evidence evidence = with_estimated_noise(0);
  for (std::size_t i = 0; i < rows_each; ++i) evidence.estimated.group[i] = assembly::known_variance;
  evidence.estimated.span.topRows(rows_each).setZero();
  const Draws found = noise_draws(evidence, draw_count, 1);
  EXPECT_NEAR(found.residuals.topRows(rows_each).cwiseAbs2().cast<double>().mean(), 1, 4 * std::sqrt(2.0 / 24000));
  EXPECT_EQ(found.precision_of_rows(0).head(rows_each), Eigen::VectorXd::Ones(rows_each));
  EXPECT_EQ(found.precision_of_rows(0)[rows_each], static_cast<double>(found.precision(1, 0)));
}

/// One curve of 200 rows whose noise replicates have said.
Evidence with_replicates(double freedom, double correlation_sd) {
  Evidence evidence;
  evidence.fit.residuals = Eigen::VectorXd::Zero(200);
  Curve curve;
  curve.count = 200;
  curve.noise.kind = NoiseSource::Kind::replicates;
  curve.noise.freedom = freedom;
  curve.noise.correlation_sd = correlation_sd;
  evidence.curves = {curve};
  return evidence;
}

/// Mean over the draws of the square of the correlation of neighbouring rows.
double squared_correlation(const Draws& found) {
  double mean = 0;
  for (const auto draw : found.residuals.colwise()) {
    const double r = static_cast<double>(draw.head(199).dot(draw.tail(199)) / draw.squaredNorm());
    mean += r * r / static_cast<double>(draw_count);
  }
  return mean;
}

// χ²_ν/ν divides: with ν = 12 the mean square is 12/10, and that of a draw has a standard deviation of √(2/8) · 1.2.
TEST(NoiseDraws, AreLargerByWhatReplicatesLeaveOpen) {
  const Draws found = noise_draws(with_replicates(12, 0), draw_count, 1);
  EXPECT_NEAR(found.residuals.cwiseAbs2().cast<double>().mean(), 1.2, 4 * 0.6 / std::sqrt(draw_count));
  EXPECT_NEAR(squared_correlation(found), 1.0 / 200, 4 * std::sqrt(2.0 / draw_count) / 200) << "no correlation";
}

// ρ ~ N(0, 0.1²): the mean of ρ² is 0.01, and 1/200 is the noise of its estimate. Four standard deviations: 6e-5.
TEST(NoiseDraws, KeepWhatACorrelationMayBeWrongBy) {
  EXPECT_NEAR(squared_correlation(noise_draws(with_replicates(1000, 0.1), draw_count, 1)), 0.01 + 0.005,
              4 * 0.015 * std::sqrt(2.0 / draw_count));
}

TEST(NoiseDraws, AreDividedByTheUncertaintyOfReplicatesOnly) {
  const Draws plain = noise_draws(with_replicates(0, 0), 20, 1);
  Evidence none = with_replicates(0, 0);
  none.curves.clear();
  EXPECT_EQ(plain.residuals, noise_draws(none, 20, 1).residuals) << "σ is stated";
  Evidence open = with_replicates(5, 0.1);
  open.curves[0].noise.kind = NoiseSource::Kind::encompassing;
  EXPECT_EQ(noise_draws(open, 20, 1).residuals, plain.residuals) << "the residuals say it";
  for (const double freedom : {0.8, 6.0}) {
    const Draws divided = noise_draws(with_replicates(freedom, 0), 20, 1);
    for (Eigen::Index b = 0; b < 20; ++b) {
      const Eigen::VectorXf ratio = divided.residuals.col(b).cwiseQuotient(plain.residuals.col(b));
      EXPECT_GT(std::abs(ratio[0] - 1), 1e-4F) << b;
      EXPECT_NEAR(ratio.maxCoeff(), ratio.minCoeff(), 1e-4F * ratio[0]) << "one σ of all rows";
    }
  }
}

// v_i = u_i + ρ v_{i−1} with one ρ a draw, from the first row of the curve on.
TEST(NoiseDraws, CarryACorrelationFromRowToRow) {
  const Draws without = noise_draws(with_replicates(1000, 0), 20, 1);
  const Draws with = noise_draws(with_replicates(1000, 0.3), 20, 1);
  for (Eigen::Index b = 0; b < 20; ++b) {
    const Eigen::VectorXd u = without.residuals.col(b).cast<double>(), v = with.residuals.col(b).cast<double>();
    EXPECT_EQ(u[0], v[0]);
    const double rho = (v - u).tail(199).dot(v.head(199)) / v.head(199).squaredNorm();
    EXPECT_LT(((v - u).tail(199) - rho * v.head(199)).norm(), 1e-4);
    EXPECT_GT(std::abs(rho), 1e-4);
  }
}

// A draw whose noise grows with the level in another way: rows of four times the variance are twice as large.
TEST(NoiseDraws, GrowWithTheLevelInOneOfTheWaysThatAreProbable) {
  Evidence evidence = with_replicates(0, 0);
  const Draws plain = noise_draws(evidence, 20, 1);
  evidence.estimated.probability = {0, 1};
  evidence.estimated.variance = Eigen::MatrixXd::Ones(200, 2);
  evidence.estimated.variance.col(1).tail(100).setConstant(4);
  const Draws grown = noise_draws(evidence, 20, 1);
  EXPECT_EQ(grown.residuals.topRows(100), plain.residuals.topRows(100));
  EXPECT_LT((grown.residuals.bottomRows(100) - 2 * plain.residuals.bottomRows(100)).norm(), 1e-4F);
}

// One row of a channel in which one degree of freedom is left: too few to be learned from. The first draw has the same
// noise either way.
TEST(NoiseDraws, LearnNothingFromChannelsWithNextToNoFreedom) {
  Evidence evidence = with_estimated_noise(20);
  const Eigen::Index last = channel_count - 1;
  evidence.estimated.span.conservativeResize(Eigen::NoChange, channel_count + 4);
  evidence.estimated.span.rightCols(4).setZero();
  for (Eigen::Index k = 0; k < 4; ++k) {  // columns that are orthogonal to a constant: 1, −1; 1, 1, −2; …
    auto column = evidence.estimated.span.col(channel_count + k).segment(last * rows_each, rows_each);
    column.head(k + 1).setOnes();
    column[k + 1] = -static_cast<double>(k + 1);
    column.normalize();
  }
  Evidence stated = evidence;
  for (Eigen::Index i = last * rows_each; i < channel_count * rows_each; ++i)
    stated.estimated.group[static_cast<std::size_t>(i)] = assembly::known_variance;
  const Draws with = noise_draws(evidence, 1, 1), without = noise_draws(stated, 1, 1);
  ASSERT_EQ(with.precision.rows(), without.precision.rows() + 1);
  EXPECT_EQ(with.precision.topRows(last), without.precision);
}

TEST(NoiseDraws, AreAsManyAsAreAskedFor) {
  const Draws found = noise_draws(with_estimated_noise(0), 700, 1);
  ASSERT_EQ(found.residuals.cols(), 700);
  for (const auto draw : found.residuals.colwise())
    EXPECT_NEAR((draw.tail(rows_each).array() - draw.tail(rows_each).mean()).square().sum(), 5, 1e-4);
}

TEST(NoiseDraws, SayThePrecisionOfEveryRow) {
  Draws draws;
  EXPECT_EQ(draws.precision_of_rows(0).size(), 0);
  draws.residuals = Eigen::MatrixXf::Zero(3, 2);
  draws.precision = (Eigen::MatrixXf(1, 2) << 2, 3).finished();
  draws.group = {0, assembly::known_variance, 0};
  EXPECT_EQ(draws.precision_of_rows(1), Eigen::Vector3d(3, 1, 3));
}

// As above with channels that differ more, and the mean of σ²/σ̂² beside that of its logarithm.
TEST(NoiseDraws, LearnLessWhereChannelsDifferMore) {
  for (const double d : {6.0, 0.5}) {
    const Draws found = noise_draws(with_estimated_noise(d), draw_count, 1);
    std::mt19937_64 generator(2);
    std::chi_squared_distribution<double> of_others(d), own(5);
    Eigen::ArrayXd logs(draw_count), precisions(draw_count);
    for (Eigen::Index b = 0; b < logs.size(); ++b) {
      std::vector<double> V(channel_count), ratios(channel_count);
      for (std::size_t g = 0; g < V.size(); ++g) {
        V[g] = 1 / std::max(of_others(generator) / d, 1e-6);
        ratios[g] = V[g] * own(generator) / 5;
      }
      const Moderation others = moderation_of(ratios, std::vector<double>(channel_count, 5));
      precisions[b] = V[0] * (others.freedom + 5) / (others.freedom * others.ratio + 5 * ratios[0]);
      logs[b] = std::pow(std::log(precisions[b]), 2);
    }
    const Eigen::ArrayXd drawn = found.precision.row(0).transpose().cast<double>().array();
    const MeanSquare log(logs), drawn_log(drawn.log().square()), precision(precisions), drawn_precision(drawn);
    EXPECT_NEAR(drawn_log.value, log.value, 4 * std::hypot(drawn_log.sd, log.sd)) << d;
    EXPECT_NEAR(drawn_precision.value, precision.value, 4 * std::hypot(drawn_precision.sd, precision.sd)) << d;
  }
}

}  // namespace
}  // namespace tunica::diagnosis
