// SPDX-License-Identifier: Apache-2.0
// How large a misfit is, against figures that can be worked out by hand.
#include "diagnosis/evidence/misfit_size.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/hand_made.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::DoubleNear;

/// Two tests of one type, curves of ten rows: s from 0 to 9 kPa with σ = 0.5, t from 0 to 90 kPa with σ = 2.
struct TwoCurves : diagnosis::HandMade {
  TwoCurves() {
    std::vector<double> x, small, large;
    for (int i = 0; i < 10; ++i) {
      x.push_back(i);
      small.push_back(i);
      large.push_back(10 * i);
    }
    add("s", x, small, {0.5, 0, 0}, diagnosis::NoiseSource::Kind::stated);
    add("t", x, large, {2, 0, 0}, diagnosis::NoiseSource::Kind::stated);
    close();
  }
  diagnosis::Fit with(double s, double t) {
    diagnosis::Fit fit = evidence.fit;
    fit.residuals.segment(curve("s").first, 10).setConstant(s);
    fit.residuals.segment(curve("t").first, 10).setConstant(t);
    fit.chi2 = fit.residuals.squaredNorm();
    return fit;
  }
};

TEST(MisfitSize, IsWhatIsBeyondNoiseInTheUnitAndOfTheRange) {
  TwoCurves bed;
  const MisfitSize size(bed.evidence);
  const auto channels = size.channels(bed.with(3, 1));
  // Ten rows of 3 σ: |r|² − ν = 90 − 10, of rms √8 σ; those of 1 σ are noise.
  EXPECT_THAT(channels[0].rms, DoubleNear(0.5 * std::sqrt(8.0), 1e-12));
  EXPECT_THAT(channels[0].range, DoubleNear(90, 1e-12)) << "that of the observable over both tests";
  EXPECT_EQ(channels[1].rms, 0);
  EXPECT_EQ(channels[1].rows, 10u);
  // In all: (Σ (σ r/range)² /|r|²/n) (|r|² − ν), with |r|² = 100 and ν = 20.
  const double weighed = 10 * std::pow(1.5 / 90, 2) + 10 * std::pow(2.0 / 90, 2);
  EXPECT_THAT(size.of(bed.with(3, 1)).rms, DoubleNear(std::sqrt(weighed / 100 / 20 * 80), 1e-12));
}

TEST(MisfitSize, HasFewerDegreesOfFreedomForEachParameterThatIsFree) {
  TwoCurves bed;
  diagnosis::Fit fit = bed.with(2, 2);
  fit.at_bound = {false, true, false, false, false};
  EXPECT_THAT(MisfitSize(bed.evidence).squares(fit), DoubleNear(80 - 16, 1e-12));
}

// A noncentral χ²₂₀ stays below 36 with 5 % where its noncentrality is 36.814: from the sum of central ones that
// Poisson weighs, summed in another program.
TEST(MisfitSize, IsBoundedByTheNoncentralityThatStaysBelowWithFivePerCent) {
  TwoCurves bed;
  const Size size = MisfitSize(bed.evidence).of(bed.with(0, std::sqrt(3.6)));
  const double scale = std::sqrt(10 * std::pow(2 / 90.0 * std::sqrt(3.6), 2) / 36 / 20);
  EXPECT_THAT(size.rms, DoubleNear(scale * 4, 1e-12));
  EXPECT_THAT(size.upper, DoubleNear(scale * std::sqrt(36.814082692589416), 1e-4));
}

TEST(MisfitSize, IsAtMostALittleWhereTheResidualsAreNoise) {
  TwoCurves bed;
  const Size size = MisfitSize(bed.evidence).of(bed.with(1, 1));
  EXPECT_EQ(size.rms, 0);
  EXPECT_GT(size.upper, 0.01);
  EXPECT_LT(size.upper, 0.05);
  EXPECT_EQ(MisfitSize(bed.evidence).of(bed.with(0.1, 0.1)).upper, 0) << "smaller than noise can be";
}

}  // namespace
}  // namespace tunica::diagnosis
