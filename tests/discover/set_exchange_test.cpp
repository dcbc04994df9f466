// SPDX-License-Identifier: Apache-2.0
// Sets in which a law takes the place of others: it begins where it comes closest to what they say.
#include <cmath>
#include <functional>

#include <gmock/gmock.h>

#include "discover/fitting.hpp"

namespace tunica::discovery::set_exchange_test {
namespace {

using trial::FittedRubber;
using trial::hidden;

void on_a_linear_scale(nlohmann::json& experiment) {
  experiment["models"]["rubber"]["parameters"]["mu"] = {
      {"initial", 300}, {"min", 1}, {"max", 900}, {"scale", "linear"}};
}

/// μ/α Σλ^α with α = −2 is μα/2 of I2: the linear law says the same from the first evaluation on.
TEST(LinearForAPower, BeginsAtTheModulusAtRest) {
  const FittedRubber rubber({.hide = hidden("I2", "linear", {{"mu", 40}}), .with = on_a_linear_scale});
  const KindPointer power = rubber.kind("stretches_falling"), linear = rubber.kind("I2_linear");
  const SetFit from = rubber.at({power}, {300, -40, -2});
  ASSERT_LT(from.chi2(), 1e-6);
  const auto simpler = rubber.fitter.with_linear(from, 0, linear);
  ASSERT_TRUE(simpler);
  ASSERT_EQ(simpler->kinds.size(), 1U);
  EXPECT_EQ(simpler->kinds[0], linear);
  EXPECT_EQ(simpler->fit.evaluations, 1U);
  EXPECT_NEAR(simpler->fit.free[0], 300, 1e-9);
  EXPECT_NEAR(simpler->fit.free[1], 40, 1e-9);
  EXPECT_EQ(simpler->log_evidence, rubber.fitter.log_evidence(*simpler));
}

/// Other terms stay where they are, and the linear law stands at its place by name.
TEST(LinearForAPower, LeavesTheOtherTermsAsTheyAre) {
  const FittedRubber rubber({.hide = hidden("I2", "linear", {{"mu", 40}}), .with = on_a_linear_scale});
  const KindPointer steep = rubber.kind("I1_cubic"), power = rubber.kind("stretches_falling"),
                    linear = rubber.kind("I2_linear");
  const BoundSet both(rubber.subject, {steep, power});
  std::vector<double> free(4);
  free[0] = 300;
  free[both.terms()[0].amplitude] = 0;
  free[both.terms()[1].amplitude] = -20;
  free[both.terms()[1].shapes[0]] = -4;
  SetFit from = rubber.at({steep, power}, free);
  EXPECT_FALSE(rubber.fitter.with_linear(from, 1, linear)) << "the cubic term has nothing to do";
  const auto fibre = std::make_shared<const Kind>(Kind{"fibre", "axial", "linear", "fibre_axial_linear"});
  EXPECT_FALSE(rubber.fitter.with_linear(from, 1, fibre)) << "fibres have no linear law";
}

/// Two terms of I2 are one: at the slope that they have together.
TEST(OneLaw, BeginsWhereItComesClosestToTheSum) {
  const FittedRubber rubber({.hide = hidden("I2", "linear", {{"mu", 40}}), .with = on_a_linear_scale});
  const KindPointer linear = rubber.kind("I2_linear"), curved = rubber.kind("I2_quadratic");
  SetFit from = rubber.at({linear, curved}, {300, 40, 0});
  const auto single = rubber.fitter.distilled(from, linear);
  ASSERT_TRUE(single);
  ASSERT_EQ(single->kinds.size(), 1U);
  EXPECT_EQ(single->fit.evaluations, 1U);
  EXPECT_NEAR(single->fit.free[1], 40, 1e-9);
}

/// A law whose shape would leave its range is another law.
TEST(OneLaw, IsNoneWhereItsShapeEndsAtItsBound) {
  const FittedRubber rubber({.hide = hidden("I2", "exponential", {{"mu", 20}, {"b", 0.1}}), .with = on_a_linear_scale});
  const SetFit from = rubber.at({rubber.kind("I2_linear"), rubber.kind("I2_quadratic")}, {300, 20, 1});
  const auto bend = [&](double low, double high) {
    return rubber.kind("I2_exponential", [=](Kind& kind) {
      kind.shapes[0].low = low;
      kind.shapes[0].high = high;
      kind.shapes[0].starts = {std::sqrt(low * high)};
    });
  };
  const auto within = rubber.fitter.distilled(from, bend(0.05, 0.2));
  ASSERT_TRUE(within);
  EXPECT_NEAR(within->fit.free[trial::place_of(*within, "I2_exponential.b")], 0.1, 1e-3);
  EXPECT_FALSE(rubber.fitter.distilled(from, bend(0.02, 0.08)));
}

/// An effect of half a σ in all rows together is nothing, even where these are few.
TEST(OneLaw, HasToDoMoreThanHalfASigma) {
  const auto distilled_of = [](double mu) {
    const FittedRubber few({.hide = hidden("I2", "linear", {{"mu", mu}}),
                            .with =
                                [](nlohmann::json& experiment) {
                                  experiment["tests"].erase("circumferential");
                                  experiment["tests"].erase("pure_shear");
                                },
                            .rows = 4});
    SetFit from = few.at({few.kind("I2_linear")}, {300, mu});
    return few.fitter.distilled(from, few.kind("I2_linear"));
  };
  const auto strong = distilled_of(40);
  ASSERT_TRUE(strong);
  // Linear in the modulus: what one kPa does.
  const double unit = strong->fit.jacobian.col(1).norm();
  EXPECT_TRUE(distilled_of(0.52 / unit));
  EXPECT_FALSE(distilled_of(0.48 / unit));
}

/// Where a fit begins that puts one law for two terms of I2: dψ/dx at 24 places between rest and all that the data
/// reach, and the law of those first shapes that is nearest to it by least squares.
std::vector<double> nearest(const Kind& law, const std::function<double(double)>& slope,
                            const std::function<double(double, double)>& unit) {
  std::vector<double> best;
  double least = INFINITY;
  for (const double shape : law.shapes[0].starts) {
    double together = 0, length = 0, misfit = 0;
    for (int i = 0; i < 24; ++i) {
      const double x = law.reach.high * (i + 0.5) / 24;
      together += slope(x) * unit(shape, x);
      length += unit(shape, x) * unit(shape, x);
    }
    for (int i = 0; i < 24; ++i) {
      const double x = law.reach.high * (i + 0.5) / 24;
      misfit += std::pow(slope(x) - together / length * unit(shape, x), 2);
    }
    if (misfit < least) {
      least = misfit;
      best = {together / length, shape};
    }
  }
  return best;
}

diagnosis::Fit fit_from(const FittedRubber& rubber, const std::vector<KindPointer>& kinds,
                        const std::vector<double>& start) {
  const BoundSet set(rubber.subject, kinds);
  const assembly::Assembly& assembly = set.assembly();
  return diagnosis::least_squares(assembly, diagnosis::all_variables(assembly), start,
                                  *assembly.evaluator().make_workspace(), 60, {.negligible = diagnosis::says_nothing});
}

/// μ/2 + kx of a linear and a quadratic law as μ/2 e^{bx}; other terms stay where they are.
TEST(OneLaw, BeginsAtTheNearestOfItsShapes) {
  const FittedRubber rubber({.hide = hidden("I2", "exponential", {{"mu", 25}, {"b", 0.08}}), .sd = 3});
  const KindPointer linear = rubber.kind("I2_linear"), curved = rubber.kind("I2_quadratic"),
                    law = rubber.kind("I2_exponential"), other = rubber.kind("I1_quadratic");
  for (const auto& [mu, k] : {std::pair(20., 0.3), std::pair(4., 4.), std::pair(30., 0.02)}) {
    const SetFit from = rubber.at({linear, curved}, {310, mu, k});
    const std::vector<double> at = nearest(
        *law, [mu = mu, k = k](double x) { return mu / 2 + k * x; },
        [](double b, double x) { return 0.5 * std::exp(b * x); });
    const auto found = rubber.fitter.distilled(from, law);
    const diagnosis::Fit expected = fit_from(rubber, {law}, {310, at[0], at[1]});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->fit.evaluations, expected.evaluations);
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(found->fit.free[j], expected.free[j], 1e-9 * expected.free[j]);
  }
  const SetFit three = rubber.at({other, linear, curved}, {290, 0.5, 20, 0.3});
  const std::vector<double> at = nearest(
      *law, [](double x) { return 10 + 0.3 * x; }, [](double b, double x) { return 0.5 * std::exp(b * x); });
  const diagnosis::Fit expected = fit_from(rubber, {other, law}, {290, 0.5, at[0], at[1]});
  const auto found = rubber.fitter.distilled(three, law);
  ASSERT_EQ(found.has_value(), expected.free[1] > 0.01);
  if (found) {
    EXPECT_EQ(found->kinds.size(), 2U);
    EXPECT_EQ(found->fit.evaluations, expected.evaluations);
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(found->fit.free[j], expected.free[j], 1e-9 * expected.free[j]);
  }
}

/// The angle of diagonal fibres is known from the terms that are replaced.
TEST(OneLaw, OfFibresKeepsTheirAngle) {
  const FittedRubber rubber(
      {.hide = hidden("fibre", "quadratic", {{"k", 8}, {"theta", 52}}, "diagonal"), .with = on_a_linear_scale});
  const KindPointer law = rubber.kind("fibre_diagonal_quadratic");
  const SetFit from = rubber.at({law}, {300, 8, 52});
  ASSERT_LT(from.chi2(), 1e-6);
  const auto found = rubber.fitter.distilled(from, law);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->fit.evaluations, 1U);
  EXPECT_NEAR(found->fit.free[2], 52, 1e-9);
}

/// A sum that falls is nearest to nothing, and amplitudes begin within their range.
TEST(OneLaw, BeginsWithinTheRangeOfItsAmplitude) {
  const FittedRubber rubber({.hide = hidden("I2", "linear", {{"mu", 40}}), .with = on_a_linear_scale});
  const KindPointer little = rubber.kind("I2_linear", [](Kind& kind) { kind.largest = 60; });
  const auto found = rubber.fitter.distilled(rubber.at({rubber.kind("I2_linear")}, {300, 90}), little);
  const diagnosis::Fit expected = fit_from(rubber, {little}, {300, 60});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->fit.evaluations, expected.evaluations);
  EXPECT_NEAR(found->fit.free[1], expected.free[1], 1e-9);
}

}  // namespace
}  // namespace tunica::discovery::set_exchange_test
