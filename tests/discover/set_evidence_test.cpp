// SPDX-License-Identifier: Apache-2.0
// What a set of terms weighs, from Jacobians that are written down here, and which amplitudes are looked for.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "discover/fitting.hpp"
#include "discovery/curves.hpp"

namespace tunica::discovery::set_evidence_test {
namespace {

using trial::FittedRubber;
using trial::ToFit;

const double of_box = 1 / std::sqrt(2 * std::numbers::pi);

ToFit nothing(const trial::Measured::Hide& hide = {}) {
  ToFit what{.hide = hide};
  what.from_nothing = true;
  return what;
}

/// −y/σ of every row, of which the energy of nothing explains none.
TEST(EvidenceOfNothing, IsThatOfTheDataThemselves) {
  const FittedRubber rubber(nothing());
  const SetFit& root = rubber.fitter.root();
  EXPECT_FALSE(root.set);
  ASSERT_EQ(root.fit.residuals.size(), 75);
  EXPECT_EQ(root.fit.jacobian.rows(), 75);
  EXPECT_EQ(root.fit.jacobian.cols(), 0);
  for (const diagnosis::Curve& curve : rubber.evidence.curves)
    for (const assembly::MeasuredChannel& view : rubber.evidence.base->layout().channels)
      if (view.test == curve.test && view.observable == curve.channel) {
        for (std::size_t i = 0; i < curve.rows.size(); ++i)
          EXPECT_NEAR(root.fit.residuals[curve.first + static_cast<Eigen::Index>(i)], -view.measured[curve.rows[i]] / 3,
                      1e-9 * rubber.measured());
      }
  const double squares = std::pow(rubber.measured(), 2);
  EXPECT_NEAR(root.chi2(), squares, 1e-9 * squares);
  EXPECT_NEAR(root.log_evidence, -squares / 2, 1e-9 * squares);
  EXPECT_EQ(root.parameter_count(), 0U);
}

/// A curve beside a base: two parameters of the base and its own four heights.
class EvidenceOfASet : public ::testing::Test {
 protected:
  EvidenceOfASet() {
    Kind curve = curve_of(*rubber.kind("I1_linear"), 3);
    curve.largest = 1000;
    curve.log_prior = -1.5;
    const auto kind = std::make_shared<const Kind>(curve);
    const BoundSet set(rubber.subject, {kind});
    const auto& parameters = set.assembly().layout().parameters;
    std::vector<double> free;
    for (const auto& parameter : parameters) free.push_back(parameter.initial);
    fit = rubber.at({kind}, free);
    fit.fit.jacobian.setZero();
    fit.fit.chi2 = 80;
  }
  /// Of a column of this length at one parameter, all others without effect.
  [[nodiscard]] double with(std::size_t parameter, double length) const {
    SetFit one = fit;
    one.fit.jacobian(3, static_cast<Eigen::Index>(parameter)) = length;
    return rubber.fitter.log_evidence(one);
  }
  const FittedRubber rubber;
  SetFit fit;
};

/// Nothing is known of any parameter: |r|², the prior, and 1 for each height of the curve but its first amplitude.
TEST_F(EvidenceOfASet, ChargesTheHeightsOfACurve) {
  ASSERT_EQ(fit.set->terms().front().heights.size(), 4U);
  EXPECT_NEAR(rubber.fitter.log_evidence(fit), -40 - 4 - 1.5, 1e-12);
  fit.fit.at_bound[fit.set->terms().front().heights[1]] = true;
  EXPECT_NEAR(rubber.fitter.log_evidence(fit), -40 - 3 - 1.5, 1e-12);
}

/// Amplitude and heights by their logarithm, W = value ln(all that is measured)/√2π.
TEST_F(EvidenceOfASet, CountsAmplitudesByTheirLogarithm) {
  const BoundTerm& term = fit.set->terms().front();
  for (const std::size_t j : {term.amplitude, term.heights[0], term.heights[3]}) {
    const double w = 0.02 * fit.fit.free[j] * std::log(rubber.measured()) * of_box;
    EXPECT_NEAR(with(j, 0.02), -45.5 - 0.5 * std::log1p(w * w), 1e-10) << j;
  }
}

/// Of a parameter of the base by its box; at its bound it costs nothing. An amplitude at its bound does.
TEST_F(EvidenceOfASet, ChargesWhatTheDataSayOfTheBase) {
  const auto& parameter = fit.set->assembly().layout().parameters[0];
  const double w = 0.5 * fit.fit.free[0] * std::log(parameter.max / parameter.min) * of_box;
  EXPECT_NEAR(with(0, 0.5), -45.5 - 0.5 * std::log1p(w * w), 1e-10);
  const std::size_t amplitude = fit.set->terms().front().amplitude;
  fit.fit.at_bound[0] = fit.fit.at_bound[amplitude] = true;
  EXPECT_NEAR(with(0, 0.5), -45.5, 1e-10);
  EXPECT_LT(with(amplitude, 0.5), -45.6);
}

TEST_F(EvidenceOfASet, IsThatOfTheMisfitWithoutParameters) {
  fit.fit.jacobian.resize(75, 0);
  EXPECT_NEAR(rubber.fitter.log_evidence(fit), -40 - 1.5, 1e-12);
  fit.set.reset();
  EXPECT_NEAR(rubber.fitter.log_evidence(fit), -40 - 1.5, 1e-12);
  fit.fit.jacobian.setOnes(75, 2);
  EXPECT_NEAR(rubber.fitter.log_evidence(fit), -40 - 1.5, 1e-12) << "columns of no set are of no parameter";
}

/// A parameter that is searched for by its value has the width of its box.
TEST(EvidenceOfABase, OnALinearScaleIsByTheWidthOfTheBox) {
  const FittedRubber rubber({.with = [](nlohmann::json& experiment) {
    experiment["models"]["rubber"]["parameters"]["mu"] = {
        {"initial", 300}, {"min", 100}, {"max", 900}, {"scale", "linear"}};
  }});
  SetFit root = rubber.fitter.root();
  root.fit.jacobian.setZero();
  root.fit.jacobian(0, 0) = 0.01;
  const double w = 0.01 * 800 * of_box;
  EXPECT_NEAR(rubber.fitter.log_evidence(root), -root.chi2() / 2 - 0.5 * std::log1p(w * w), 1e-10);
}

/// σ stated so large that all that is measured is a few σ.
ToFit vague(double sigma, bool from_nothing = false) {
  ToFit what{.with = [sigma](nlohmann::json& experiment) {
    for (auto& [name, test] : experiment["tests"].items()) test["data"]["noise"] = {{"absolute", sigma}};
  }};
  what.from_nothing = from_nothing;
  return what;
}

/// Length of what one unit of the amplitude of a term does, where it acts beside `beside` as measured.
double unit_effect(const FittedRubber& rubber, std::vector<KindPointer> kinds, std::vector<double> free,
                   std::size_t amplitude, double step) {
  const SetFit less = rubber.at(kinds, free);
  free[amplitude] += step;
  return (rubber.at(kinds, free).fit.residuals - less.fit.residuals).norm() / std::abs(step);
}

/// Twenty times what is measured, and no less than of ten σ; never above 1e5 kPa.
TEST(LargestAmplitude, IsOfTenSigmaWhereLessIsMeasured) {
  const FittedRubber some(vague(3e3));
  ASSERT_LT(some.measured(), 10);
  const KindPointer second = some.kind("I2_linear");
  const double effect = unit_effect(some, {second}, {300, 0}, 1, 10);
  EXPECT_NEAR(second->largest, 20 * 10 / effect, 1e-6 * second->largest);
  const FittedRubber little(vague(3e6));
  EXPECT_EQ(little.kind("I2_linear")->largest, 1e5);
  EXPECT_EQ(little.kind("stretches_rising")->largest, 5000);
  EXPECT_EQ(little.kind("stretches_falling")->largest, -5000);
}

/// The shape at which the term does least, ψ' = μ/2 e^{bx}: the gentlest exponential, b = 1/(2X).
TEST(LargestAmplitude, IsThatOfTheWeakestShape) {
  const FittedRubber rubber;
  const KindPointer law = rubber.kind("I1_exponential");
  ASSERT_EQ(law->shapes.size(), 1U);
  const double b = 0.5 / law->reach.high;
  double squares = 0;  // of 2ψ'/μ, times what one kPa of a linear law does
  const SetFit linear = rubber.at({rubber.kind("I1_linear")}, {300, 0});
  for (const diagnosis::Curve& curve : rubber.evidence.curves)
    for (std::size_t i = 0; i < curve.abscissa.size(); ++i) {
      const double l = curve.abscissa[i];
      const double first = curve.test == "equibiaxial"  ? 2 * l * l + std::pow(l, -4)
                           : curve.test == "pure_shear" ? l * l + 1 + 1 / (l * l)
                                                        : l * l + 2 / l;
      squares +=
          std::pow(std::exp(b * (first - 3)) * linear.fit.jacobian(curve.first + static_cast<Eigen::Index>(i), 1), 2);
    }
  EXPECT_NEAR(law->largest, 20 * rubber.measured() / std::sqrt(squares), 1e-6 * law->largest);
}

/// From nothing a fibre stands beside the neo-Hookean law that the data ask for, at the angle at which it does least.
TEST(LargestAmplitude, FromNothingIsBesideTheFirstTerm) {
  const FittedRubber rubber(nothing());
  const KindPointer fibre = rubber.kind("fibre_diagonal_quadratic"), first = rubber.kind("I1_linear");
  const std::vector<KindPointer> both{fibre, first};
  const BoundSet set(rubber.subject, both);
  std::vector<double> free(3);
  free[set.terms()[0].amplitude] = 1e-3;
  free[set.terms()[1].amplitude] = 300;
  double least = INFINITY;
  for (const double theta : {30., 45., 60.}) {
    free[set.terms()[0].shapes[0]] = theta;
    least = std::min(least, unit_effect(rubber, both, free, set.terms()[0].amplitude, 1e-3));
  }
  EXPECT_NEAR(fibre->largest, 20 * rubber.measured() / least, 1e-4 * fibre->largest);
}

/// Of a curve by the height that does most.
TEST(LargestAmplitude, OfACurveIsThatOfItsStrongestHeight) {
  const FittedRubber rubber;
  Kind curve = curve_of(*rubber.kind("I1_linear"), 3);
  curve.largest = 10;
  const auto kind = std::make_shared<const Kind>(curve);
  std::vector<double> free(6, 0.0);
  free[0] = 300;
  double most = 0;
  for (std::size_t j = 1; j < 6; ++j) most = std::max(most, unit_effect(rubber, {kind}, free, j, 1));
  const double largest = rubber.fitter.largest_amplitude(curve);
  EXPECT_NEAR(largest, 20 * rubber.measured() / most, 1e-6 * largest);
}

/// By more than ten in ln of the evidence, and by a tenth of what 100 rows leave beyond noise.
TEST(SetFit, IsClearlyBetterByEvidenceAndMisfitTogether) {
  const auto leaving = [](double chi2, double log_evidence) {
    SetFit one;
    one.fit.chi2 = chi2;
    one.fit.residuals = Eigen::VectorXd::Zero(100);
    one.log_evidence = log_evidence;
    return one;
  };
  const SetFit other = leaving(1100, -500);
  EXPECT_TRUE(leaving(990, -489).is_clearly_better_than(other));
  EXPECT_FALSE(leaving(1010, -489).is_clearly_better_than(other)) << "less than a tenth of 1000";
  EXPECT_FALSE(leaving(990, -491).is_clearly_better_than(other)) << "hardly likelier";
}

/// What cannot act is not looked for: a law that fibres do not have, and fibres that no test stretches.
TEST(LargestAmplitude, IsNoneOfWhatCannotAct) {
  const FittedRubber rubber;
  EXPECT_EQ(rubber.fitter.largest_amplitude({"fibre", "axial", "linear", "wrong"}), 0);
  const FittedRubber strip({.with = [](nlohmann::json& experiment) {
    experiment["tests"].erase("equibiaxial");
    experiment["tests"].erase("pure_shear");
  }});
  EXPECT_EQ(strip.fitter.largest_amplitude({"fibre", "axial", "quadratic", "slack"}), 0);
  EXPECT_GT(strip.fitter.largest_amplitude({"fibre", "circumferential", "quadratic", "taut"}), 0);
}

}  // namespace
}  // namespace tunica::discovery::set_evidence_test
