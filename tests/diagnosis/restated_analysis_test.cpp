// SPDX-License-Identifier: Apache-2.0
// Whether an extension's residuals say another noise: strips without a word about theirs, seed 1.
#include <cmath>
#include <limits>
#include <optional>

#include <gmock/gmock.h>

#include "diagnosis/detection/analysis.hpp"
#include "diagnosis/evidence/encompassing_noise.hpp"
#include "diagnosis/measured.hpp"

namespace tunica::diagnosis::restated_analysis_test {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

class Strips {
 public:
  explicit Strips(bool silent = true) : measured_({{}, {.name = "axial"}}) {
    measured_.measure(1);
    if (silent)
      for (auto& [name, test] : measured_.experiment["tests"].items()) test["data"].erase("noise");
    read_ = measured_.read();
    request_ = request_of(read_);
    request_.quick = true;
    analysis = analyse(inquiry(), {});
  }
  [[nodiscard]] Inquiry inquiry() const { return {read_, request_, testing::catalogue(), silence_}; }
  /// What the residuals of a fit say of the noise.
  [[nodiscard]] std::vector<NoiseSource> noise_of(const Fit& fit) const {
    return encompassing_noise(analysis.evidence, fit, visible_signatures(analysis.hypotheses)).sources;
  }
  [[nodiscard]] std::optional<Analysis> again(const std::vector<NoiseSource>& before, const Fit& fit) const {
    Analysis changed = analysis;
    changed.evidence.noise = before;
    return restated(inquiry(), changed, fit);
  }
  /// A fit whose residuals grow or shrink with what is predicted.
  [[nodiscard]] Fit changing(bool up) const {
    Fit fit = analysis.evidence.fit;
    for (const Curve& curve : analysis.evidence.curves)
      for (Eigen::Index i = 0; i < curve.count; ++i)
        fit.residuals[curve.first + i] = 0.2 * static_cast<double>(up ? i : curve.count - i) *
                                         std::sin(2.3 * static_cast<double>(i * i) + static_cast<double>(curve.first));
    return fit;
  }
  Analysis analysis;

 private:
  trial::Measured measured_;
  experiment::Experiment read_;
  Request request_;
  Progress silence_;
};

const Strips& silent_strips() {
  static const Strips strips;
  return strips;
}

TEST(RestatedAnalysis, IsNoneOfNoiseThatIsStated) {
  const Strips strips(false);
  EXPECT_THAT(strips.analysis.evidence.noise_warnings, IsEmpty());
  Fit fit = strips.analysis.evidence.fit;
  fit.residuals *= 5;
  EXPECT_FALSE(restated(strips.inquiry(), strips.analysis, fit));
}

TEST(RestatedAnalysis, IsOneOfSigmasThatChangeByMoreThanATenth) {
  const Strips& strips = silent_strips();
  const Fit& fit = strips.analysis.evidence.fit;
  const std::vector<NoiseSource> now = strips.noise_of(fit);
  ASSERT_EQ(now.size(), 2u);
  EXPECT_FALSE(strips.again(now, fit));
  for (const std::size_t k : {0, 1})
    for (const double change : {-0.11, -0.09, 0.09, 0.11}) {
      std::vector<NoiseSource> before = now;
      before[k].noise.absolute *= std::exp(change);
      const auto found = strips.again(before, fit);
      EXPECT_EQ(found.has_value(), std::abs(change) > 0.1) << k << change;
      if (found) {
        EXPECT_NEAR(found->evidence.noise[k].noise.absolute, now[k].noise.absolute, 1e-9);
        EXPECT_NEAR(found->evidence.curves[k].noise.noise.absolute, now[k].noise.absolute, 1e-9);
      }
    }
}

TEST(RestatedAnalysis, IsOneOfNoiseThatGrowsOtherwise) {
  const Strips& strips = silent_strips();
  const Fit fit = strips.changing(true);
  const std::vector<NoiseSource> now = strips.noise_of(fit);
  for (const NoiseSource& source : now) {
    ASSERT_GT(source.noise.relative, 0);
    ASSERT_LT(source.noise.relative, 1);
  }
  EXPECT_FALSE(strips.again(now, fit));
  for (const double change : {-0.11, -0.09, 0.09, 0.11}) {
    std::vector<NoiseSource> before = now;
    before[1].noise.relative *= std::exp(change);
    EXPECT_EQ(strips.again(before, fit).has_value(), std::abs(change) > 0.1) << change;
  }
  std::vector<NoiseSource> before = now;
  before[0].noise.relative = 0;
  EXPECT_TRUE(strips.again(before, fit)) << "it did not grow";
  const Fit plain = strips.changing(false);
  std::vector<NoiseSource> constant = strips.noise_of(plain);
  for (NoiseSource& source : constant) {
    ASSERT_EQ(source.noise.relative, 0);
    source.noise.relative = 1e-3;
  }
  EXPECT_TRUE(strips.again(constant, plain)) << "it grew";
}

// What mechanisms could explain is no noise, so that fewer degrees of freedom are left than before they were known.
TEST(RestatedAnalysis, StartsFromNoiseOutsideOfEveryMechanism) {
  const Strips& strips = silent_strips();
  const Evidence before = evidence_of(strips.inquiry(), {});
  const Analysis& analysis = strips.analysis;
  for (const std::size_t k : {0, 1}) EXPECT_LT(analysis.evidence.noise[k].freedom, before.noise[k].freedom - 0.5) << k;
  EXPECT_GT(analysis.evidence.estimated.span.cols(), before.estimated.span.cols());
  ASSERT_TRUE(analysis.alarm.detector);
  EXPECT_EQ(analysis.alarm.p(), alarm_of(strips.inquiry(), analysis.evidence, analysis.hypotheses).p());
}

TEST(RestatedAnalysis, SaysAgainWhatItsNoiseIsAndWhetherAnythingIsWrong) {
  const Strips& strips = silent_strips();
  EXPECT_THAT(strips.analysis.evidence.noise_warnings, Not(IsEmpty()));
  for (const NoiseSource& source : strips.analysis.evidence.noise)
    EXPECT_EQ(source.kind, NoiseSource::Kind::encompassing);
  Fit fit = strips.analysis.evidence.fit;
  fit.residuals *= 0.5;
  Analysis before = strips.analysis;
  before.evidence.noise_warnings.clear();
  const auto found = restated(strips.inquiry(), before, fit);
  ASSERT_TRUE(found);
  EXPECT_THAT(found->evidence.noise_warnings, Not(IsEmpty()));
  // Four times the squares at half the σ: the alarm is that of the new evidence.
  EXPECT_NEAR(found->evidence.fit.chi2, 4 * strips.analysis.evidence.fit.chi2, 0.2 * strips.analysis.evidence.fit.chi2);
  EXPECT_EQ(found->alarm.p(), alarm_of(strips.inquiry(), found->evidence, found->hypotheses).p());
  EXPECT_GT(found->alarm.p(), 0);
  EXPECT_LT(found->alarm.p(), 1);
}

}  // namespace
}  // namespace tunica::diagnosis::restated_analysis_test
