// SPDX-License-Identifier: Apache-2.0
// Ranges of shapes where data reach very little or very much, and what a kind tells the mechanism that adds it.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "discovery/kinds.hpp"

namespace tunica::discovery::kind_ranges_test {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;

/// C_tt = 1 + X: I1 − 3 and the circumferential I4 − 1 are X, I2 − 3 is 2X.
States up_to(double X) { return {{1 + X, 1, 1, 0, 0, 0}}; }

Kind kind_of(const States& states, const std::string& name) {
  for (const Kind& kind : kinds_of({}, states, true))
    if (kind.name == name) return kind;
  throw std::out_of_range(name);
}

void expect_shape(const States& states, const std::string& name, double low, double high,
                  const std::vector<double>& starts) {
  const Shape shape = kind_of(states, name).shapes.at(0);
  EXPECT_NEAR(shape.low, low, 1e-9 * std::abs(low)) << name;
  EXPECT_NEAR(shape.high, high, 1e-9 * std::abs(high)) << name;
  EXPECT_THAT(shape.starts, Pointwise(DoubleNear(1e-9 * std::abs(high)), starts)) << name;
}

/// Within the bounds that the laws declare; starts that fall together are one.
TEST(RangesOfShapes, StayWhereLawsAreDeclared) {
  expect_shape(up_to(0.01), "I1_exponential", 5, 100, {50, 100});
  expect_shape(up_to(100), "I1_exponential", 1e-3, 0.25, {0.005, 0.02, 0.06});
  expect_shape(up_to(0.01), "fibre_circumferential_exponential_square", 100, 100, {100});
  expect_shape(up_to(100), "fibre_circumferential_exponential_square", 1e-3, 2.5e-3, {1e-3});
  expect_shape(up_to(0.004), "I1_gent", 0.01, 0.2, {0.01, 0.032});
  expect_shape(up_to(1000), "I1_gent", 1002, 1e4, {1100, 2000, 8000});
  expect_shape(up_to(0.005), "I1_inverse_langevin", 1.05, 1 + 0.25 / 3, {1.05});
  expect_shape(up_to(1000), "I1_inverse_langevin", 335, 1e4, {1 + 1100. / 3, 1 + 2000. / 3, 1 + 8000. / 3});
}

/// λ = 3 reaches e^15 with 13.7, λ = e³ with 5 (drawn out or pressed together alike); never less than 3, never
/// above 30.
TEST(RangesOfShapes, OfPowersEndWhereTheLargestStretchDoes) {
  const double wide = 15 / std::log(3);
  expect_shape(up_to(8), "stretches_rising", 0.2, wide, {1.4, 3, 6, 12});
  expect_shape(up_to(8), "stretches_falling", -wide, -0.2, {-8, -3, -1});
  const States pressed{{std::exp(-6), 1, 1, 0, 0, 0}};
  expect_shape(pressed, "stretches_rising", 0.2, 5, {1.4, 3, 5});
  expect_shape(pressed, "stretches_falling", -5, -0.2, {-5, -3, -1});
  const States far = up_to(std::exp(12));
  expect_shape(far, "stretches_rising", 0.2, 3, {1.4, 3});
  expect_shape(far, "stretches_falling", -3, -0.2, {-3, -1});
  expect_shape(up_to(0.1), "stretches_rising", 0.2, 30, {1.4, 3, 6, 12});
  expect_shape(up_to(0.1), "stretches_falling", -30, -0.2, {-8, -3, -1});
}

TEST(KindsOfStretches, KnowTheirSignAndTheirReach) {
  const Kind rising = kind_of(up_to(8), "stretches_rising"), falling = kind_of(up_to(8), "stretches_falling");
  EXPECT_FALSE(rising.negative);
  EXPECT_TRUE(falling.negative);
  EXPECT_EQ(rising.amplitude(), "mu");
  EXPECT_NEAR(rising.reach.high, std::log(3), 1e-12);
  EXPECT_NEAR(falling.reach.high, std::log(3), 1e-12);
  // Pressed together I1 and I2 do not grow here, but stretches are below 1.
  const std::vector<Kind> of_pressed = kinds_of({}, {{0.5, 1, 1, 0, 0, 0}}, true);
  ASSERT_EQ(of_pressed.size(), 2U);
  EXPECT_EQ(of_pressed[0].invariant + of_pressed[1].invariant, "stretchesstretches");
  Request linear;
  linear.laws = {"linear"};
  for (const Kind& kind : kinds_of(linear, up_to(8), true)) EXPECT_EQ(kind.law, "linear") << kind.name;
  EXPECT_EQ(kinds_of(linear, up_to(8), false).size(), 2U) << "I1 and I2 need no directions";
}

/// The widest of angles from 20° to 70°: I4 = ½(C_tt + C_zz) + ½(C_zz − C_tt) cos 2θ + C_tz sin 2θ is largest at the
/// angle that the shear and the difference of stretches are made for.
TEST(KindsOfDiagonalFibres, ReachAsFarAsAnyAngle) {
  for (const double degrees : {20., 30., 40., 50., 60., 70.})
    for (const double sign : {1., -1.}) {
      const double twice = 2 * degrees * std::numbers::pi / 180, size = 0.3 * sign;
      const States states{
          {1, 1, 1, 0, 0, 0},
          {1 + size - size * std::cos(twice), 1 + size + size * std::cos(twice), 1, size * std::sin(twice), 0, 0}};
      Request request;
      request.invariants = {"fibre diagonal", "stretches"};
      request.laws = {"quadratic", "power"};
      const std::vector<Kind> kinds = kinds_of(request, states, true);
      const auto diagonal =
          std::find_if(kinds.begin(), kinds.end(), [](const Kind& kind) { return kind.family == "diagonal"; });
      if (sign < 0) {
        EXPECT_EQ(diagonal, kinds.end()) << "no fibre is drawn out";
        continue;
      }
      ASSERT_NE(diagonal, kinds.end());
      EXPECT_NEAR(diagonal->reach.high, 0.6, 1e-12) << degrees;
      EXPECT_NEAR(diagonal->reach.low, 0, 1e-12) << degrees;
    }
  // Drawn out along one axis and pressed together along the other: cos² 20° of each.
  const States both{{1.5, 0.6, 1, 0, 0, 0}};
  const Kind diagonal = kind_of(both, "fibre_diagonal_quadratic");
  const double most = std::pow(std::cos(std::numbers::pi / 9), 2);
  EXPECT_NEAR(diagonal.reach.high, 0.5 * most - 0.4 * (1 - most), 1e-12);
  EXPECT_NEAR(diagonal.reach.low, 0.5 * (1 - most) - 0.4 * most, 1e-12);
}

TEST(KindsOfFibres, AlongAnAxisReachItsStretch) {
  const States states{{1.5, 1.2, 1, 0, 0, 0}};
  EXPECT_NEAR(kind_of(states, "fibre_circumferential_quadratic").reach.high, 0.5, 1e-12);
  EXPECT_NEAR(kind_of(states, "fibre_axial_quadratic").reach.high, 0.2, 1e-12);
}

/// A term is added to an energy by these options of the mechanism.
TEST(OptionsOfAKind, SayTheTerm) {
  const auto text = [](const Options& options, const char* name) { return options.text(name); };
  const Options of_fibre = kind_of(up_to(8), "fibre_circumferential_exponential_square").options();
  EXPECT_EQ(text(of_fibre, "invariant"), "fibre");
  EXPECT_EQ(text(of_fibre, "family"), "circumferential");
  EXPECT_EQ(text(of_fibre, "law"), "exponential_square");
  EXPECT_EQ(text(of_fibre, "dispersion"), "none");
  EXPECT_EQ(text(of_fibre, "fibre_switch"), "strain");
  EXPECT_EQ(text(of_fibre, "knots"), "[]");
  Kind stretches = kind_of(up_to(8), "stretches_rising");
  stretches.law = "rising";
  EXPECT_EQ(text(stretches.options(), "law"), "power") << "stretches have one law";
  EXPECT_EQ(text(stretches.options(), "family"), "axial") << "what nobody asks";
  Kind curve{"I1", "", "spline", "I1_curve"};
  curve.knots = {0, 0.5, 2};
  EXPECT_EQ(text(curve.options(), "knots"), "[0, 0.5, 2]");
}

TEST(CurvesInPlaceOfALaw, ReachAsFar) {
  const Kind kind = kind_of(up_to(8), "I1_linear");
  EXPECT_EQ(curve_of(kind, 3).reach.high, kind.reach.high);
  EXPECT_NEAR(curve_of(kind, 3).knots.back(), 8, 1e-12);
}

}  // namespace
}  // namespace tunica::discovery::kind_ranges_test
