// SPDX-License-Identifier: Apache-2.0
// Arithmetic of jets and of jets of jets (jet_functions.hpp): every function against differences of the formula with
// numbers, and where powers are delicate against closed forms.
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tunica/detail/lanes.hpp"
#include "tunica/detail/taylor.hpp"
#include "tunica/models/jet_functions.hpp"

namespace tunica {
namespace {

// Of unlike sizes, as in respond_by_autodiff() and JointEnergy.
using Jet = ceres::Jet<double, 3>;
using Nested = ceres::Jet<Jet, 2>;

/// x and y as independent variables: derivatives of first order in v, of second order in the v of v.
Jet jet(double value, int place) { return Jet(value, place); }
Nested nested(double value, int place) {
  Nested x(Jet(value, place));
  x.v[place] = Jet(1.0);
  return x;
}

/// Two points at once.
using InLanes = Taylor<1, detail::Lanes<2>>;

/// One formula for every kind of number.
struct Formula {
  std::string name;
  std::function<double(double, double)> plain;
  std::function<Jet(Jet, Jet)> single;
  std::function<Nested(Nested, Nested)> twofold;
  std::function<Taylor<1>(Taylor<1>, Taylor<1>)> taylor;
  std::function<InLanes(InLanes, InLanes)> lanes;
};
template <class F>
Formula formula(std::string name, F f) {
  return {std::move(name), f, f, f, f, f};
}
#define FORMULA(expression)                               \
  formula(#expression, [](const auto& x, const auto& y) { \
    using namespace functions;                            \
    static_cast<void>(x), static_cast<void>(y);           \
    return std::decay_t<decltype(x)>(expression);         \
  })

std::vector<Formula> formulas() {
  return {FORMULA(abs(x)),
          FORMULA(abs(-x)),
          FORMULA(acos(x)),
          FORMULA(asin(x)),
          FORMULA(atan(x)),
          FORMULA(atan2(x, y)),
          FORMULA(atan2(x, 2)),
          FORMULA(atan2(-1.5, y)),
          FORMULA(cbrt(x)),
          FORMULA(cbrt(-x)),
          FORMULA(cos(x)),
          FORMULA(cosh(x)),
          FORMULA(erf(x)),
          FORMULA(erfc(x)),
          FORMULA(exp(x)),
          FORMULA(expm1(x)),
          FORMULA(hypot(x, y)),
          FORMULA(log(x)),
          FORMULA(log10(x)),
          FORMULA(log1p(x)),
          FORMULA(max(x, y) * min(x, y) * min(x, y)),
          FORMULA(max(x, 0.1) * max(2.0, y) * max(0.5, x)),
          FORMULA(min(x, 0.1) * min(2.0, y) * min(0.5, x) + min(y, 3.0) * x),
          FORMULA(pow(x, y)),
          FORMULA(pow(x, x)),
          FORMULA(pow(x, 2.5)),
          FORMULA(pow(x, -3)),
          FORMULA(pow(-x, 3)),
          FORMULA(pow(-x, 4.0)),
          FORMULA(pow(x, 0) + pow(x, 1) + pow(x, 2)),
          FORMULA(pow(2.0, x)),
          FORMULA(pow(3, x)),
          FORMULA(sin(x)),
          FORMULA(sinh(x)),
          FORMULA(sqrt(x)),
          FORMULA(tan(x)),
          FORMULA(tanh(x)),
          FORMULA(1 + x * y + 2 * x - y * 3 + x / 4 - 5 / y),
          FORMULA(1.5 + x * y + 2.5 * x - y * 3.5 + x / 4.5 - 5.5 / y),
          FORMULA(exp(-pow(x, y) / (1 + pow(2.0, y * x))) * log1p(sqrt(x) * y))};
}

constexpr double x0 = 0.37, y0 = 1.3;

/// Central differences of fourth order.
template <class F>
double slope(const F& f, double at, double h) {
  return (8 * (f(at + h) - f(at - h)) - (f(at + 2 * h) - f(at - 2 * h))) / (12 * h);
}
void expect_near(double found, double expected, double tolerance, const std::string& what) {
  EXPECT_NEAR(found, expected, tolerance * (1 + std::abs(expected))) << what;
}

TEST(Jets, HaveTheValueOfTheFormulaWithNumbers) {
  for (const Formula& f : formulas()) {
    const double value = f.plain(x0, y0);
    EXPECT_DOUBLE_EQ(f.single(jet(x0, 0), jet(y0, 1)).a, value) << f.name;
    EXPECT_DOUBLE_EQ(f.twofold(nested(x0, 0), nested(y0, 1)).a.a, value) << f.name;
  }
}

TEST(Jets, HaveTheSlopesOfTheFormulaWithNumbers) {
  for (const Formula& f : formulas()) {
    const Jet found = f.single(jet(x0, 0), jet(y0, 1));
    expect_near(found.v[0], slope([&](double x) { return f.plain(x, y0); }, x0, 1e-3), 1e-8, f.name + " by x");
    expect_near(found.v[1], slope([&](double y) { return f.plain(x0, y); }, y0, 1e-3), 1e-8, f.name + " by y");
    EXPECT_EQ(found.v[2], 0) << f.name;
  }
}

TEST(NestedJets, HaveTheSlopesOfJetsTwice) {
  for (const Formula& f : formulas()) {
    const Nested found = f.twofold(nested(x0, 0), nested(y0, 1));
    for (int i = 0; i < 2; ++i) {
      const auto first = [&](double x, double y) { return f.single(jet(x, 0), jet(y, 1)).v[i]; };
      expect_near(found.a.v[i], first(x0, y0), 1e-14, f.name + ", inner");
      expect_near(found.v[i].a, first(x0, y0), 1e-14, f.name + ", outer");
      expect_near(found.v[i].v[0], slope([&](double x) { return first(x, y0); }, x0, 1e-3), 1e-7, f.name + " by x");
      expect_near(found.v[i].v[1], slope([&](double y) { return first(x0, y); }, y0, 1e-3), 1e-7, f.name + " by y");
      EXPECT_EQ(found.v[i].v[2], 0) << f.name;
    }
  }
}

/// With x as the argument of a law, and y as its parameter.
TEST(TaylorNumbers, HaveTheDerivativesOfJetsTwice) {
  for (const Formula& f : formulas()) {
    const Nested jets = f.twofold(nested(x0, 0), nested(y0, 1));
    const Taylor<1> found = f.taylor(Taylor<1>::argument(x0), Taylor<1>::parameter(y0, 0));
    expect_near(found.value, jets.a.a, 1e-14, f.name);
    expect_near(found.x, jets.a.v[0], 1e-13, f.name + " by x");
    expect_near(found.xx, jets.v[0].v[0], 1e-13, f.name + " by x twice");
    expect_near(found.p[0], jets.a.v[1], 1e-13, f.name + " by y");
    expect_near(found.xp[0], jets.v[0].v[1], 1e-13, f.name + " by x and y");
  }
}

TEST(TaylorNumbers, AreTheSameInEveryLane) {
  const double x1 = 1.01 * x0, y1 = 0.99 * y0;  // of the same branch
  for (const Formula& f : formulas()) {
    detail::Lanes<2> x(x0), y(y0);
    x.v[1] = x1;
    y.v[1] = y1;
    detail::lanes_in_step = 3;
    const InLanes found = f.lanes(InLanes::argument(x), InLanes::parameter(y, 0));
    EXPECT_EQ(detail::lanes_in_step, 3u) << f.name;
    for (const int lane : {0, 1}) {
      const Taylor<1> alone =
          f.taylor(Taylor<1>::argument(lane == 0 ? x0 : x1), Taylor<1>::parameter(lane == 0 ? y0 : y1, 0));
      expect_near(found.value.v[lane], alone.value, 1e-14, f.name);
      expect_near(found.x.v[lane], alone.x, 1e-14, f.name + " by x");
      expect_near(found.xx.v[lane], alone.xx, 1e-14, f.name + " by x twice");
      expect_near(found.p[0].v[lane], alone.p[0], 1e-14, f.name + " by y");
      expect_near(found.xp[0].v[lane], alone.xp[0], 1e-14, f.name + " by x and y");
    }
  }
}

TEST(TaylorNumbers, TellWhichLanesTookTheBranchOfTheFirst) {
  detail::Lanes<2> x(1.0);
  x.v[1] = -1;
  detail::lanes_in_step = 3;
  EXPECT_EQ(abs(InLanes::argument(x)).value.v[0], 1);
  EXPECT_EQ(detail::lanes_in_step, 1u);
}

/// x^2 by x at x = 0 and below, where logarithms are not.
TEST(TaylorNumbers, HavePowersOfZeroAndOfNegativeNumbers) {
  for (const double exponent : {0., 1., 2., 3., 4.5}) {
    const auto zero = Taylor<1>::argument(0), power = pow(zero, exponent), same = pow(zero, Taylor<1>(exponent));
    for (const auto& found : {power, same}) {
      EXPECT_EQ(found.value, exponent == 0 ? 1 : 0);
      EXPECT_EQ(found.x, exponent == 1 ? 1 : 0);
      EXPECT_EQ(found.xx, exponent == 2 ? 2 : 0);
    }
  }
  const auto by_exponent = pow(Taylor<1>::argument(0), Taylor<1>::parameter(2.5, 0));
  EXPECT_EQ(by_exponent.p[0], 0);
  EXPECT_EQ(by_exponent.xp[0], 0);
  // ∂²(f^g)/∂f∂g = f^(g − 1) (1 + g ln f) has no limit here.
  EXPECT_EQ(pow(Taylor<1>::argument(0), Taylor<1>::parameter(1, 0)).xp[0], -std::numeric_limits<double>::infinity());
  EXPECT_FALSE(std::isfinite(pow(Taylor<1>::argument(0), Taylor<1>::parameter(0.5, 0)).xp[0]));
  EXPECT_EQ(pow(Taylor<1>::argument(-1.5), 2).xx, 2);
  EXPECT_EQ(pow(Taylor<1>::argument(-1.5), 3).x, 6.75);
}

template <class J>
void expect_compound(J x) {
  const J whole = 3 * ((x + 1.0 - 2) * 4.0) / 8;
  J w = x;
  w += 1.0;
  w -= 2;
  w *= 4.0;
  w *= 3;
  w /= 8;
  EXPECT_EQ(w, whole);
  EXPECT_EQ(w.v[0], whole.v[0]);
  w += x;
  EXPECT_EQ(w, whole + x);
}
TEST(NestedJets, AreChangedInPlaceByNumbers) {
  expect_compound(jet(x0, 0));
  expect_compound(nested(x0, 0));
}

template <class J>
void expect_order(const J& x, const J& y) {
  EXPECT_TRUE(x < 1.0 && x <= 1 && 1 > x && 1.0 >= x && x != 1.0 && x == x && x == x0);
  EXPECT_FALSE(x > 1 || x >= 1.0 || 1.0 < x || 1 <= x || x == 1);
  EXPECT_TRUE(x < y && x <= y && y > x && y >= x && x != y);
}
TEST(NestedJets, AreOrderedByTheirValues) {
  expect_order(jet(x0, 0), jet(y0, 1));
  expect_order(nested(x0, 0), nested(y0, 1));
}

/// x^p at x = 0, where logarithms are not.
TEST(NestedJets, HavePowersOfZero) {
  using functions::pow;
  const Nested zero = nested(0, 0), p = nested(2.5, 1);
  for (const double exponent : {0., 1., 2., 3., 4.5}) {
    const Nested power = pow(zero, exponent), same = pow(zero, Nested(Jet(exponent)));
    EXPECT_EQ(power.a.a, exponent == 0 ? 1 : 0);
    EXPECT_EQ(power.a.v[0], exponent == 1 ? 1 : 0);
    EXPECT_EQ(power.v[0].a, exponent == 1 ? 1 : 0);
    EXPECT_EQ(power.v[0].v[0], exponent == 2 ? 2 : 0);
    EXPECT_EQ(same.v[0].v[0], exponent == 2 ? 2 : 0);
  }
  const Nested power = pow(zero, p);
  EXPECT_EQ(power.a.a, 0);
  EXPECT_EQ(power.v[0].a, 0);
  EXPECT_EQ(power.v[1].a, 0);
  EXPECT_EQ(power.v[0].v[0], 0);
  EXPECT_EQ(pow(jet(0, 0), 0).v[0], 0);
  EXPECT_EQ(pow(0.0, p).v[1].v[1], 0);
}

/// (−x)^2 by x is a number, by a parameter that happens to be 2 it is none.
TEST(NestedJets, HaveWholePowersOfNegativeNumbers) {
  using functions::pow;
  const Nested x = nested(-1.5, 0);
  Nested two(Jet(2.0, 1));  // a parameter: derivatives inside only
  const Nested power = pow(x, two);
  EXPECT_EQ(power.a.a, 2.25);
  EXPECT_EQ(power.v[0].a, -3);
  EXPECT_EQ(power.v[0].v[0], 2);
  EXPECT_TRUE(std::isnan(power.a.v[1]));
  two = Nested(Jet(2.0));
  EXPECT_EQ(pow(x, two).v[0].v[0], 2);
}

TEST(NestedJets, HaveTheRightSlopeOfTheMagnitudeAtZero) {
  using functions::abs;
  const Nested magnitude = abs(nested(0, 0));
  EXPECT_EQ(magnitude.v[0].a, 1);
  EXPECT_EQ(magnitude.v[0].v[0], 0);
}

TEST(Functions, AnswerNumbersToo) {
  using namespace functions;
  EXPECT_EQ(max(1.0, 2.0) + min(1.0, 2.0) + abs(-1.5) + pow(2.0, 3.0), 12.5);
}

}  // namespace
}  // namespace tunica
