// SPDX-License-Identifier: Apache-2.0
// What is said of noise that nobody stated.
#include "diagnosis/evidence/estimate_warnings.hpp"

#include <random>

#include <gmock/gmock.h>

#include "diagnosis/evidence/row_correlation.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

NoiseSource source(const std::string& test, NoiseSource::Kind kind, data::Noise noise) {
  NoiseSource found{test, "stress", "kPa", kind, noise};
  found.freedom = 20;
  return found;
}
using Kind = NoiseSource::Kind;

std::vector<Warning> warnings_of(const std::vector<NoiseSource>& sources) {
  Evidence evidence;
  for (const NoiseSource& one : sources) {
    Curve curve;
    curve.noise = one;
    evidence.curves.push_back(curve);
  }
  return estimate_warnings(evidence, {});
}

std::string text_of(const std::vector<NoiseSource>& sources) { return warnings_of(sources).at(0).text; }

TEST(EstimateWarnings, AreOfOpenNoiseOnly) {
  EXPECT_THAT(warnings_of({source("a", Kind::stated, {1, 0}), source("b", Kind::replicates, {1, 0})}), IsEmpty());
  const auto found = warnings_of({source("a", Kind::stated, {1, 0}), source("b", Kind::encompassing, {1, 0})});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].kind, WarningKind::noise_estimated);
  EXPECT_THAT(found[0].text, Not(HasSubstr("a, stress")));
}

TEST(EstimateWarnings, SaySigmaWithItsUnitAndWhereItComesFrom) {
  EXPECT_EQ(text_of({source("a", Kind::encompassing, {0.2, 0.031}), source("b", Kind::differences, {0.5, 0})}),
            "no noise is stated. σ is estimated from the part of the residuals that neither a mechanism nor a smooth "
            "shape can explain: a, stress 0.2 kPa and 3.1 % of the value. What is as rough as noise from row to row "
            "counts as noise. Too few rows are left for that here, and σ is taken from differences of neighbouring "
            "rows: b, stress 0.5 kPa. State noise.absolute, noise.relative and noise.correlation, or give replicates");
  NoiseSource ratio = source("a", Kind::encompassing, {0.2, 0});
  ratio.unit = "1";
  EXPECT_THAT(text_of({ratio}), HasSubstr("a, stress 0.2. What"));
}

TEST(EstimateWarnings, ListFourChannelsAndCountTheOthers) {
  std::vector<NoiseSource> sources;
  for (const char* name : {"a", "b", "c", "d"}) sources.push_back(source(name, Kind::encompassing, {1, 0}));
  EXPECT_THAT(text_of(sources), HasSubstr("c, stress 1 kPa; d, stress 1 kPa. What"));
  sources.push_back(source("e", Kind::encompassing, {1, 0}));
  sources.push_back(source("f", Kind::encompassing, {1, 0}));
  EXPECT_THAT(text_of(sources), HasSubstr("d, stress 1 kPa; and 2 more in result.json. What"));
}

// F with 20 and 20 degrees of freedom exceeds 4 with p = 0.00158: twice that, in both directions, is no chance only
// beyond 1e-3, and F = 6.25 has p = 0.00007.
TEST(EstimateWarnings, SayWhatNeighbouringRowsContradict) {
  NoiseSource one = source("a", Kind::encompassing, {2, 0});
  one.neighbours = 1;
  one.neighbours_freedom = 20;
  EXPECT_NEAR(contradiction(one), 2 * 0.001579, 1e-6);
  one.noise.absolute = 3;
  one.neighbours = 1.5;
  EXPECT_NEAR(contradiction(one), 2 * 0.001579, 1e-6) << "the ratio alone counts";
  one.noise.absolute = 2;
  one.neighbours = 1;
  EXPECT_THAT(text_of({one}), Not(HasSubstr("give another σ")));
  one.noise.absolute = 2.5;
  EXPECT_THAT(text_of({one}), HasSubstr("give another σ, by more than chance: a, stress (1 kPa). It is larger"));
  const double larger = contradiction(one);
  std::swap(one.noise.absolute, one.neighbours);
  EXPECT_NEAR(contradiction(one), larger, 1e-12) << "the freedoms are equal";
  EXPECT_THAT(text_of({one}), HasSubstr("a, stress (2.5 kPa)"));
}

// Twelve channels: the one that contradicts is looked at twelve times as hard, 0.00014 · 12 > 0.001.
TEST(EstimateWarnings, CountTheChannelsThatWereLookedAt) {
  NoiseSource one = source("a", Kind::encompassing, {2.5, 0});
  one.neighbours = 1;
  one.neighbours_freedom = 20;
  std::vector<NoiseSource> sources{one};
  EXPECT_GT(12 * contradiction(one), 1e-3);
  EXPECT_LT(2 * contradiction(one), 1e-3);
  sources.push_back(source("b", Kind::differences, {1, 0}));
  EXPECT_THAT(text_of(sources), HasSubstr("give another σ"));
  sources.insert(sources.end(), 10, source("b", Kind::differences, {1, 0}));
  EXPECT_THAT(text_of(sources), Not(HasSubstr("give another σ")));
}

TEST(EstimateWarnings, CompareOnlyWhatCanBeCompared) {
  NoiseSource one = source("a", Kind::encompassing, {9, 0});
  one.neighbours_freedom = 20;
  EXPECT_EQ(contradiction(one), 1) << "there are no neighbours";
  one.neighbours = 1;
  EXPECT_LT(contradiction(one), 1e-6);
  one.noise.relative = 0.1;
  EXPECT_EQ(contradiction(one), 1) << "noise that grows";
  one.noise.relative = 0;
  one.freedom = 0;
  EXPECT_EQ(contradiction(one), 1) << "known";
  one.freedom = 0.9;
  EXPECT_LT(contradiction(one), 1) << "little is known of it";
  one.freedom = 20;
  one.kind = Kind::differences;
  EXPECT_EQ(contradiction(one), 1) << "it is the differences";
}

/// One curve of 200 rows whose mean is fitted, and residuals of which each shares `correlation` with the one before.
/// Rows from `gap` on have another number: the rows there are no neighbours.
struct Chain {
  Evidence evidence;
  Fit fit;

  explicit Chain(double correlation, std::size_t gap = 200, std::uint64_t seed = 1) {
    std::mt19937_64 generator(seed);
    std::normal_distribution<double> normal;
    Curve curve;
    curve.count = 200;
    for (std::size_t i = 0; i < 200; ++i) curve.rows.push_back(i < gap ? i : i + 5);
    curve.noise = source("a", NoiseSource::Kind::encompassing, {1, 0});
    evidence.curves = {curve};
    evidence.estimated.span = Eigen::MatrixXd::Constant(200, 1, 1 / std::sqrt(200.0));
    evidence.estimated.group.assign(200, 0);
    fit.residuals.resize(200);
    double last = normal(generator);
    for (double& value : fit.residuals) {
      value = last;
      last = correlation * last + std::sqrt(1 - correlation * correlation) * normal(generator);
    }
  }
};

// 199 pairs: the standard deviation is near 1/√199 = 0.071. Seed 1; four of them: 6e-5.
TEST(EstimateWarnings, SayThatNeighboursShareTheirErrors) {
  const Chain independent(0), alike(0.5);
  const auto none = row_correlation(independent.evidence, independent.fit),
             half = row_correlation(alike.evidence, alike.fit);
  ASSERT_TRUE(none && half);
  EXPECT_NEAR(none->sd, 1 / std::sqrt(199.0), 1e-3);
  EXPECT_NEAR(none->value, 0, 4 * none->sd);
  EXPECT_NEAR(half->value, 0.5, 4 * half->sd);
  EXPECT_THAT(estimate_warnings(independent.evidence, independent.fit), SizeIs(1));
  const auto found = estimate_warnings(alike.evidence, alike.fit);
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(found[1].kind, WarningKind::rows_correlated);
  EXPECT_THAT(found[1].text, HasSubstr("neighbouring rows share their errors: correlation 0."));
}

// Seeds 1 … 2000, white noise: the mean has a standard deviation of 0.071/√2000, and four of them are 6e-5. Without the
// correction it would be −1/200 from the fitted mean alone.
TEST(EstimateWarnings, AreNotMisledByWhatTheFitTook) {
  double mean = 0, square = 0, sd = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const Chain chain(0, 100, seed);
    const auto found = row_correlation(chain.evidence, chain.fit);
    mean += found->value / 2000;
    square += found->value * found->value / 2000;
    sd = found->sd;
  }
  EXPECT_NEAR(sd, 1 / std::sqrt(198.0), 1e-3) << "two rows with others between them are no pair";
  EXPECT_NEAR(mean, 0, 4 * sd / std::sqrt(2000.0));
  EXPECT_NEAR(square / (sd * sd), 1, 4 * std::sqrt(2.0 / 2000));
}

}  // namespace
}  // namespace tunica::diagnosis
