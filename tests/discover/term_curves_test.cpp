// SPDX-License-Identifier: Apache-2.0
// Terms as curves with their bands, and free curves in the place of laws.
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gmock/gmock.h>

#include "discover/fitting.hpp"
#include "discovery/curves.hpp"

namespace tunica::discovery::term_curves_test {
namespace {

using ::testing::Each;
using ::testing::IsEmpty;
using trial::FittedRubber;
using trial::hidden;

/// A set whose parameters are known: by a Jacobian that makes their covariance what a test says.
SetFit known(const FittedRubber& rubber, const std::vector<KindPointer>& kinds, const std::vector<double>& free,
             const Eigen::MatrixXd& covariance, double log_evidence = 0) {
  SetFit fit = rubber.at(kinds, free);
  fit.fit.jacobian = covariance.inverse().llt().matrixU();
  fit.log_evidence = log_evidence;
  return fit;
}

Eigen::MatrixXd spread(const std::vector<double>& deviations) {
  Eigen::MatrixXd C =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(deviations.size()), static_cast<Eigen::Index>(deviations.size()));
  for (std::size_t j = 0; j < deviations.size(); ++j)
    C(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(j)) = deviations[j] * deviations[j];
  return C;
}

/// ψ' = μ/2 e^{bx} on 61 places from rest to all that the data reach; 1.96 standard deviations by the covariance of the
/// term's own parameters.
TEST(CurveOfATerm, HasTheBandOfItsParameters) {
  const FittedRubber rubber;
  const KindPointer law = rubber.kind("I2_exponential");
  Eigen::MatrixXd C = spread({10, 2, 0.01});
  C(1, 2) = C(2, 1) = -0.012;
  C(0, 1) = C(1, 0) = 5;
  const TermCurve curve = curve_of_term(rubber.subject, known(rubber, {law}, {300, 20, 0.1}, C), 0);
  ASSERT_EQ(curve.x.size(), 61U);
  ASSERT_EQ(curve.low.size(), 61U);
  for (std::size_t i = 0; i < 61; ++i) {
    const double x = law->reach.high * static_cast<double>(i) / 60, e = std::exp(0.1 * x);
    EXPECT_NEAR(curve.x[i], x, 1e-12 * law->reach.high);
    EXPECT_NEAR(curve.slope[i], 10 * e, 1e-9 * e);
    const double by_mu = 0.5 * e, by_b = 10 * x * e;
    const double half = 1.96 * std::sqrt(4 * by_mu * by_mu + 1e-4 * by_b * by_b - 0.024 * by_mu * by_b);
    EXPECT_NEAR(curve.high[i] - curve.slope[i], half, 1e-6 * half) << i;
    EXPECT_NEAR(curve.slope[i] - curve.low[i], half, 1e-6 * half) << i;
  }
}

/// Over the principal stretches from the least to the largest: ψ' = μ λ^(α−1).
TEST(CurveOfATerm, OfStretchesIsOverTheStretch) {
  const FittedRubber rubber;
  const KindPointer law = rubber.kind("stretches_rising");
  const TermCurve curve = curve_of_term(rubber.subject, known(rubber, {law}, {300, 4, 5}, spread({10, 0.5, 0.2})), 0);
  ASSERT_EQ(curve.x.size(), 61U);
  for (std::size_t i = 0; i < 61; ++i) {
    const double t = static_cast<double>(i) / 60;
    const double stretch = std::exp(law->reach.low + t * (law->reach.high - law->reach.low));
    const double power = std::pow(stretch, 4);
    EXPECT_NEAR(curve.x[i], stretch, 1e-12 * stretch);
    EXPECT_NEAR(curve.slope[i], 4 * power, 1e-9 * power);
    const double half = 1.96 * std::hypot(0.5 * power, 0.2 * 4 * power * std::log(stretch));
    EXPECT_NEAR(curve.high[i] - curve.slope[i], half, 1e-6 * half) << i;
  }
}

/// The second of two terms.
TEST(CurveOfATerm, IsThatOfTheTermAskedFor) {
  const FittedRubber rubber;
  const std::vector<KindPointer> kinds{rubber.kind("I1_quadratic"), rubber.kind("I2_linear")};
  const SetFit both = known(rubber, kinds, {300, 3, 50}, spread({10, 1, 7}));
  const TermCurve second = curve_of_term(rubber.subject, both, 1);
  EXPECT_THAT(second.slope, Each(::testing::DoubleNear(25, 1e-9)));
  EXPECT_NEAR(second.high[30], 25 + 1.96 * 3.5, 1e-6);
  const TermCurve first = curve_of_term(rubber.subject, both, 0);
  EXPECT_NEAR(first.slope.back(), 3 * first.x.back(), 1e-9 * first.slope.back());
}

/// Another law of the same invariant has the weight of its evidence; the band holds how far it is off.
TEST(MixedCurve, HoldsWhatOtherLawsSay) {
  const FittedRubber rubber;
  const KindPointer linear = rubber.kind("I2_linear"), curved = rubber.kind("I2_quadratic"),
                    first = rubber.kind("I1_quadratic");
  const double weight = 0.4;
  const std::vector<SetFit> sets{
      known(rubber, {first, linear}, {300, 3, 50}, spread({10, 1, 7}), -40),
      known(rubber, {first}, {300, 3}, spread({10, 1}), -40.1),  // other invariants
      known(rubber, {first, curved}, {300, 3, 4}, spread({10, 1, 0.3}), -40 + std::log(weight)),
      known(rubber, {first, curved}, {300, 3, 400}, spread({10, 1, 0.3}), -40 + std::log(0.009)),  // too unlikely
  };
  const TermCurve curve = mixed_curve(rubber.subject, sets, 1);
  for (std::size_t i = 0; i < 61; ++i) {
    const double x = curve.x[i];
    EXPECT_NEAR(curve.slope[i], 25, 1e-9) << "of the best";
    const double variance = (3.5 * 3.5 + weight * (std::pow(0.3 * x, 2) + std::pow(4 * x - 25, 2))) / (1 + weight);
    EXPECT_NEAR(curve.high[i] - 25, 1.96 * std::sqrt(variance), 1e-6 * std::sqrt(variance)) << i;
    EXPECT_NEAR(25 - curve.low[i], 1.96 * std::sqrt(variance), 1e-6 * std::sqrt(variance)) << i;
  }
  // Its own place in the other set: sets need not list their terms alike.
  std::vector<SetFit> turned = sets;
  turned[2] = known(rubber, {curved, first}, {300, 4, 3}, spread({10, 0.3, 1}), -40 + std::log(weight));
  EXPECT_NEAR(mixed_curve(rubber.subject, turned, 1).high[40], curve.high[40], 1e-6);
}

/// Two terms of one invariant cannot be told apart by it, and stretches have no common abscissa: the term alone.
TEST(MixedCurve, IsThatOfTheTermWhereNoOtherIsComparable) {
  const FittedRubber rubber;
  const KindPointer linear = rubber.kind("I2_linear"), curved = rubber.kind("I2_quadratic"),
                    rising = rubber.kind("stretches_rising");
  const std::vector<SetFit> two{known(rubber, {linear, curved}, {300, 50, 2}, spread({10, 7, 1})),
                                known(rubber, {linear, curved}, {300, 20, 9}, spread({10, 7, 1}))};
  EXPECT_EQ(mixed_curve(rubber.subject, two, 0).high, curve_of_term(rubber.subject, two[0], 0).high);
  const std::vector<SetFit> powers{known(rubber, {rising}, {300, 4, 5}, spread({10, 1, 1})),
                                   known(rubber, {rising}, {300, 9, 3}, spread({10, 1, 1}))};
  EXPECT_EQ(mixed_curve(rubber.subject, powers, 0).high, curve_of_term(rubber.subject, powers[0], 0).high);
}

/// Which curves with how many knots come, each in the place of the laws of its invariant.
TEST(CurvesForLaws, TakeThePlaceOfTheLawsOfAnInvariant) {
  const FittedRubber rubber({.hide = hidden("I2", "exponential", {{"mu", 25}, {"b", 0.08}}), .sd = 3});
  const std::vector<KindPointer> kinds{rubber.kind("I1_quadratic"), rubber.kind("I2_linear"),
                                       rubber.kind("I2_quadratic"), rubber.kind("stretches_rising")};
  const auto best = rubber.fitter.grown(rubber.fitter.root(), kinds[1], -INFINITY);
  ASSERT_TRUE(best);
  const std::vector<SetFit> found = with_curves(rubber.fitter, *best, kinds, false);
  ASSERT_FALSE(found.empty());
  std::vector<std::size_t> knots;
  for (const SetFit& set : found) {
    ASSERT_EQ(set.kinds.size(), 1U);
    EXPECT_EQ(set.kinds[0]->name, "I2_curve");
    EXPECT_LT(set.chi2(), best->chi2());
    EXPECT_NE(set.kinds[0]->largest, 0);
    knots.push_back(set.kinds[0]->knots.size());
  }
  EXPECT_THAT(knots, ::testing::IsSubsetOf({4U, 6U, 9U}));
  EXPECT_THAT(knots, ::testing::Contains(4U));
  for (std::size_t k = 1; k < found.size(); ++k) EXPECT_GE(found[k - 1].log_evidence, found[k].log_evidence);
  EXPECT_THAT(with_curves(rubber.fitter, *best, {kinds[0], kinds[3]}, false), IsEmpty()) << "nothing to replace";
}

/// Beside the laws where that is asked for.
TEST(CurvesForLaws, StandBesideThem) {
  const FittedRubber rubber({.hide =
                                 [](nlohmann::json& experiment) {
                                   hidden("I2", "linear", {{"mu", 60}})(experiment);
                                   nlohmann::json second = {{"type", "added_term"},
                                                            {"as", "second"},
                                                            {"invariant", "I1"},
                                                            {"law", "quadratic"},
                                                            {"parameters", {{"k", {{"initial", 20}}}}}};
                                   experiment["models"]["rubber"]["mechanisms"].push_back(second);
                                 },
                             .sd = 3});
  const std::vector<KindPointer> kinds{rubber.kind("I1_quadratic"), rubber.kind("I2_linear")};
  const auto best = rubber.fitter.grown(rubber.fitter.root(), kinds[1], -INFINITY);
  ASSERT_TRUE(best);
  const std::vector<SetFit> found = with_curves(rubber.fitter, *best, kinds, true);
  bool beside = false;
  for (const SetFit& set : found) {
    const bool both = set.kinds.size() == 2;
    if (both) {
      beside = true;
      EXPECT_EQ(set.kinds[0]->name, "I1_curve");
      EXPECT_EQ(set.kinds[1]->name, "I2_linear");
    } else {
      ASSERT_EQ(set.kinds.size(), 1U);
      EXPECT_EQ(set.kinds[0]->name, "I2_curve");
    }
  }
  EXPECT_TRUE(beside);
}

}  // namespace
}  // namespace tunica::discovery::term_curves_test
