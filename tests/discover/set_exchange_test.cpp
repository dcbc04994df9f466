// SPDX-License-Identifier: Apache-2.0
// Sets in which a law takes the place of others: it begins where it comes closest to what they say.
#include <cmath>

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

}  // namespace
}  // namespace tunica::discovery::set_exchange_test
