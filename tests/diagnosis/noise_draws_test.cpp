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

}  // namespace
}  // namespace tunica::diagnosis
