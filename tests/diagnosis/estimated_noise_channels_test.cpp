// SPDX-License-Identifier: Apache-2.0
// σ from residuals that are made by hand: noise that grows with the values, and channels that know of each other.
#include <gmock/gmock.h>

#include "assembly/growing_noise.hpp"
#include "diagnosis/evidence/moderation.hpp"
#include "diagnosis/hand_made.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::Pointwise;

/// A curve of 26 values, of which a fit takes the last 24.
struct Channel {
  std::string name, unit = "kPa";
  double first = 1, last = 11, sd = 0.5;
  double correlation = 0;  ///< where it is not 0, levels are what was measured
  double resolution = 0;
};

struct ManyChannels : HandMade {
  explicit ManyChannels(std::vector<Channel> all) : channels(std::move(all)) {
    for (const Channel& one : channels) {
      add(one.name, fakes::grid(0, 1, 26), fakes::grid(one.first, one.last, 26), {one.sd, 0, 0}).hold_out.rows =
          data::RowRange{0, 2, 1};
      NoiseSource& own = evidence.noise.back();
      own.unit = one.unit;
      own.noise.correlation = one.correlation;
      own.resolution = one.resolution;
    }
    close();
  }
  [[nodiscard]] Eigen::VectorXd measured(std::size_t k) const {
    return Eigen::VectorXd::LinSpaced(26, channels[k].first, channels[k].last).tail(24);
  }
  /// Errors of a channel that are this share of its values.
  void let_grow(std::size_t k, double share) {
    const Eigen::VectorXd errors = share * measured(k).cwiseProduct(rough(24, static_cast<double>(k + 1)));
    evidence.fit.residuals.segment(evidence.curves[k].first, 24) = errors / channels[k].sd;
  }
  [[nodiscard]] Eigen::VectorXd level(std::size_t k) const {
    const double sd = channels[k].correlation == 0 ? channels[k].sd : 0;
    return measured(k) + sd * evidence.fit.residuals.segment(evidence.curves[k].first, 24);
  }
  [[nodiscard]] double range(std::size_t k) const { return level(k).maxCoeff() - level(k).minCoeff(); }

  std::vector<Channel> channels;
};

/// The same in the units of the channels, a group for each; the families are given by channel.
struct InUnits {
  InUnits(const ManyChannels& bed, const std::vector<std::size_t>& families) {
    const auto n = bed.evidence.fit.residuals.size();
    Eigen::VectorXd level(n), sd(n);
    std::vector<Eigen::MatrixXd> columns;
    for (std::size_t k = 0; k < bed.channels.size(); ++k) {
      const Eigen::Index first = bed.evidence.curves[k].first;
      columns.push_back(bed.powers(bed.channels[k].name, 6));
      problem.group.insert(problem.group.end(), 24, k);
      problem.least.push_back(std::pow(bed.channels[k].resolution, 2));
      level.segment(first, 24) = bed.level(k);
      sd.segment(first, 24).setConstant(bed.channels[k].sd);
    }
    columns.push_back(bed.evidence.fit.jacobian);
    problem.columns = sd.asDiagonal() * beside(columns);
    problem.residuals = sd.cwiseProduct(bed.evidence.fit.residuals);
    problem.shape = Eigen::VectorXd::Ones(n);
    growing = growing_noise(problem, families, level);
    own = restricted_variance(problem);
  }
  [[nodiscard]] double mean_shape(std::size_t k) const {
    return problem.shape.segment(24 * static_cast<Eigen::Index>(k), 24).mean();
  }
  assembly::VarianceProblem problem;
  assembly::GrowingNoise growing;
  assembly::RestrictedVariance own;
};

TEST(GrowingChannels, AreSeenByObservableAtWhatIsPredicted) {
  // "s" falls, so that its first value is the largest, and is small: a tenth of the others.
  ManyChannels bed({{"s", "kPa", 0.8, 0.1, 0.05}, {"v", "N"}, {"t", "kPa", 1, 20, 0.5, 0.3}});
  bed.let_grow(0, 0.1);
  bed.evidence.fit.residuals.segment(24, 24) = shrinking(24, 2);
  bed.let_grow(2, 0.08);
  const NoiseEstimate found = bed.estimate();
  const InUnits expected(bed, {0, 1, 0});
  const std::vector<double>& share = expected.growing.share;
  ASSERT_GT(share[0], 1);
  ASSERT_NE(share[0], share[1]);
  for (const std::size_t k : {0, 1, 2}) {
    const double a = std::sqrt(expected.own.variance[k]), largest = bed.level(k).cwiseAbs().maxCoeff();
    EXPECT_NEAR(found.sources[k].noise.absolute, a, 1e-4 * a) << k;
    EXPECT_NEAR(found.sources[k].noise.relative, a * std::sqrt(share[k % 2]) / largest, 1e-5) << k;
    EXPECT_NEAR(found.sources[k].freedom, 18, 1e-6) << k;
    EXPECT_EQ(found.sources[k].noise.correlation, 0);
  }
  EXPECT_THAT(found.from.probability, Not(IsEmpty()));
  EXPECT_THAT(found.from.probability, Pointwise(::testing::DoubleNear(1e-6), expected.growing.probability));
  EXPECT_LT((found.from.variance - expected.growing.variance).norm(), 1e-4);
}

TEST(GrowingChannels, OfOneTestAreKeptApart) {
  HandMade bed;
  const std::vector<double> x = fakes::grid(0, 1, 24);
  bed.add_test("s", x, rising(x), true).data.noise = {{"y", {0.5, 0, 0}}, {"z", {0.5, 0, 0}}};  // z = 10 y
  NoiseSource source{"s", "y", "kPa", NoiseSource::Kind::differences, {0.5, 0, 0}};
  bed.evidence.noise = {source, source};
  bed.evidence.noise[1].channel = "z";
  bed.close();
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(rising(x).data(), 24);
  bed.evidence.fit.residuals << 0.2 * y.cwiseProduct(rough(24, 1)), 5 * 0.2 * y.cwiseProduct(rough(24, 2));
  const NoiseEstimate found = bed.estimate();
  ASSERT_GT(found.sources[0].noise.relative, 0);
  EXPECT_GT(found.sources[1].noise.absolute, 3 * found.sources[0].noise.absolute);
  EXPECT_LT(found.sources[1].noise.relative, 0.2);
  const double share_y = std::pow(found.sources[0].noise.relative / found.sources[0].noise.absolute, 2),
               share_z = std::pow(found.sources[1].noise.relative / found.sources[1].noise.absolute, 2);
  const auto largest = [&](double factor, Eigen::Index first) {
    return (factor * y + 0.5 * bed.evidence.fit.residuals.segment(first, 24)).cwiseAbs().maxCoeff();
  };
  // Both have one share of (level/largest level)².
  EXPECT_NEAR(share_y * std::pow(largest(1, 0), 2), share_z * std::pow(largest(10, 24), 2), 1e-6);
}

// Channel "t" reads noise about 0, where the model predicts 0: exactly with σ = 1/8, up to rounding with 0.13.
TEST(GrowingChannels, DoNotGrowWhereNothingIsPredicted) {
  const std::vector<double> x = fakes::grid(0, 1, 24), y = rising(x);
  const Eigen::VectorXd read = 0.2 * rough(24, 5);
  for (const double sd : {0.125, 0.13}) {
    HandMade bed;
    bed.add("s", x, y, {0.5, 0, 0});
    bed.add("t", x, std::vector<double>(read.begin(), read.end()), {sd, 0, 0});
    bed.close();
    bed.evidence.fit.residuals << 0.4 * Eigen::Map<const Eigen::VectorXd>(y.data(), 24).cwiseProduct(rough(24, 1)),
        -read / sd;
    const NoiseEstimate found = bed.estimate();
    EXPECT_GT(of(found, "s").noise.relative, 0) << sd;
    EXPECT_EQ(of(found, "t").noise.relative, 0) << sd;
    const double freedom = 18;
    EXPECT_NEAR(of(found, "t").noise.absolute,
                std::sqrt(squares_outside(bed.powers("t", 6).bottomRows(24), read) / freedom), 1e-3)
        << sd;
  }
}

/// Channels whose errors are 5 … 12 % of values up to 11 … 40, some of another unit; one of no range, one of hardly
/// any, one at its resolution, and one of which a fit leaves one degree of freedom.
struct Moderated : ManyChannels {
  explicit Moderated(double resolution_of_a = 0)
      : ManyChannels({{"a", "kPa", 1, 11, 0.5, 0, resolution_of_a},
                      {"b", "N", 1, 20, 0.25},
                      {"c", "kPa", 1, 30},
                      {"d", "N", 1, 40, 0.25},
                      {"flat", "kPa", 5, 5, 0.5, 0.3},
                      {"narrow", "kPa", 5, 5.2, 0.5, 0.3},
                      {"coarse", "kPa", 1, 11, 0.5, 0, 0.05},
                      {"spent", "mm", 1, 11}}) {
    const std::vector<double> shares{0.12, 0.05, 0.07, 0.1, 0.05, 0.002, 1e-4, 0.1};
    for (std::size_t k = 0; k < shares.size(); ++k) let_grow(k, shares[k]);
    for (int j = 0; j < 17; ++j) add_column(in_curve("spent", rough(24, 3.1 * (j + 1))));
  }
};

TEST(ModeratedChannels, KnowOfTheSharesThatOthersHaveOfTheirRanges) {
  const Moderated bed;
  const NoiseEstimate found = bed.estimate();
  const InUnits expected(bed, {0, 1, 0, 1, 0, 0, 0, 2});
  const auto& own = expected.own;
  ASSERT_TRUE(own.at_least[6]);
  ASSERT_NEAR(own.freedom[7], 1, 1e-6);
  ASSERT_GT(expected.growing.share[0], 0.1);
  std::vector<double> ratios, freedom;
  for (const std::size_t k : {0, 1, 2, 3, 5}) {
    ratios.push_back(own.variance[k] * expected.mean_shape(k) / std::pow(bed.range(k), 2));
    freedom.push_back(own.freedom[k]);
  }
  const Moderation others = moderation_of(ratios, freedom);
  ASSERT_GT(others.freedom, 1);
  EXPECT_NEAR(found.from.moderation, others.freedom, 1e-4 * others.freedom);
  for (const std::size_t k : {0, 1, 2, 3, 5}) {
    const double of_others = others.ratio * std::pow(bed.range(k), 2) / expected.mean_shape(k);
    const double nu = own.freedom[k], d = others.freedom;
    const double sd = std::sqrt((nu * own.variance[k] + d * of_others) / (nu + d));
    EXPECT_NEAR(found.sources[k].noise.absolute, sd, 1e-4 * sd) << k;
    EXPECT_NEAR(found.sources[k].freedom, nu + d, 1e-3) << k;
  }
  EXPECT_NEAR(found.sources[4].noise.absolute, std::sqrt(own.variance[4]), 1e-4) << "no range";
  EXPECT_NEAR(found.sources[4].freedom, own.freedom[4], 1e-3);
  EXPECT_NEAR(found.sources[6].noise.absolute, 0.05, 1e-9) << "the resolution";
  EXPECT_EQ(found.sources[6].freedom, 0);
  EXPECT_EQ(found.sources[7].noise.absolute, 0.5) << "as it was";
}

TEST(ModeratedChannels, AreNotBelowTheirResolution) {
  const Moderated bed;
  const double own = std::sqrt(InUnits(bed, {0, 1, 0, 1, 0, 0, 0, 2}).own.variance[0]),
               moderated = bed.estimate().sources[0].noise.absolute;
  ASSERT_LT(moderated, 0.99 * own);
  const double between = (moderated + own) / 2;
  const NoiseSource found = Moderated(between).estimate().sources[0];
  EXPECT_EQ(found.noise.absolute, between);
  EXPECT_GT(found.freedom, 18);
}

// Errors of 0.001, 0.01, 0.1 and 1 of a range: the others are worth less than one degree of freedom, and more than
// none.
TEST(ModeratedChannels, LearnLittleFromOthersThatHaveLittleInCommon) {
  ManyChannels bed({{"a", "kPa"}, {"b", "N"}, {"c", "mm"}, {"d", "mN"}});
  for (std::size_t k = 0; k < 4; ++k)
    bed.evidence.fit.residuals.segment(24 * static_cast<Eigen::Index>(k), 24) =
        std::pow(10.0, static_cast<double>(k) - 2) * shrinking(24, static_cast<double>(k));
  const NoiseEstimate found = bed.estimate();
  EXPECT_GT(found.from.moderation, 0);
  EXPECT_LT(found.from.moderation, 1);
  for (const NoiseSource& source : found.sources) EXPECT_NEAR(source.freedom, 18 + found.from.moderation, 1e-6);
}

}  // namespace
}  // namespace tunica::diagnosis
