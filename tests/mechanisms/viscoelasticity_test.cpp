// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include <gtest/gtest.h>

#include "deformations.hpp"
#include "shelf.hpp"

namespace tunica::viscoelasticity_test {
namespace {

using testing::evaluate;
using testing::model;
using testing::random_deformations;
using testing::relative_difference;
using testing::uniaxial_deformation;
using testing::wrapped;

constexpr double mu = 12, g = 0.8, tau = 5;
const std::vector<double> neo_hookean{mu, g, tau};

/// A material point that is led along a path; the state is taken over after each step.
class Point {
 public:
  explicit Point(const Model& model, std::vector<double> parameters = neo_hookean)
      : model_(model), parameters_(std::move(parameters)) {}

  std::vector<double> step(const std::vector<double>& C, double time_step) {
    auto response = evaluate(model_, C, parameters_, {.state = true}, {time_step}, state_);
    state_ = response.state;
    return response.stress;
  }
  std::vector<double> trial(const std::vector<double>& C, double time_step) const {
    return evaluate(model_, C, parameters_, {}, {time_step}, state_).stress;
  }

 private:
  const Model& model_;
  std::vector<double> parameters_, state_;
};

/// Dev S of the neo-Hookean solid S = μ 1 at diag(λ², 1/λ, 1/λ).
testing::Tensor neo_hookean_deviator(double stretch) {
  const double third = (stretch * stretch + 2 / stretch) / 3;
  return {mu * (1 - third / (stretch * stretch)), mu * (1 - third * stretch), mu * (1 - third * stretch), 0, 0, 0};
}

TEST(Viscoelasticity, RelaxesExponentiallyAfterAJump) {
  const auto viscous = wrapped("viscoelasticity", model("neo_hooke"));
  Point point(*viscous);
  const std::vector<double> C = uniaxial_deformation(1.4);
  const testing::Tensor jump = neo_hookean_deviator(1.4);
  double time = 0;
  for (const double dt : {0.0, 0.7, 0.0, 4.0, 30.0}) {
    time += dt;
    const std::vector<double> stress = point.step(C, dt);
    for (std::size_t c = 0; c < 6; ++c) {
      const double expected = (c < 3 ? mu : 0) + g * std::exp(-time / tau) * jump[c];
      EXPECT_NEAR(stress[c], expected, 1e-13 * mu) << "component " << c << " at " << time << " s";
    }
  }
}

TEST(Viscoelasticity, FollowsTheClosedFormAtAConstantStressRate) {
  // λ⁻³ = 1 − 3rt/(2μ) makes S'_tt = r t; then h_tt = g τ r (1 − e^{−t/τ}), whatever the steps.
  constexpr double rate = 0.4;
  const auto viscous = wrapped("viscoelasticity", model("neo_hooke"));
  Point point(*viscous);
  double previous = 0;
  for (const double time : {0.01, 0.5, 3.0, 3.1, 9.0, 14.0}) {
    const double stretch = std::pow(1 - 3 * rate * time / (2 * mu), -1. / 3);
    const std::vector<double> stress = point.step(uniaxial_deformation(stretch), time - previous);
    EXPECT_NEAR(stress[0] - mu, -g * tau * rate * std::expm1(-time / tau), 1e-12 * mu) << time << " s";
    previous = time;
  }
}

TEST(Viscoelasticity, ConvergesWithTheSquareOfTheStep) {
  const auto viscous = wrapped("viscoelasticity", model("hgo"));
  const std::vector<double> hgo{18.7, 24.9, 0.9, 46, g, tau};
  const auto end_of_path = [&](int steps) {
    Point point(*viscous, hgo);
    std::vector<double> stress;
    for (int k = 1; k <= steps; ++k) {
      const double time = 8. * k / steps;
      stress = point.step(uniaxial_deformation(1 + 0.3 * std::sin(0.35 * time)), 8. / steps);
    }
    return stress;
  };
  const std::vector<double> exact = end_of_path(4096);
  const double coarse = relative_difference(end_of_path(32), exact), fine = relative_difference(end_of_path(64), exact);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.05);
}

TEST(Viscoelasticity, IsTheBareModelAtTheNullBitForBit) {
  const auto bare = model("hgo");
  const auto viscous = wrapped("viscoelasticity", model("hgo"));
  const std::vector<double> hgo{18.7, 24.9, 0.9, 46}, at_null{18.7, 24.9, 0.9, 46, 0, tau};
  const std::vector<double> C = random_deformations(10, 4), time_step(10, 0.3);
  const auto start = evaluate(*viscous, random_deformations(10, 5), at_null, {.state = true}, time_step);
  const auto a = evaluate(*viscous, C, at_null, {.state = true}, time_step, start.state);
  const auto b = evaluate(*bare, C, hgo);
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.stress, b.stress);
  EXPECT_EQ(a.tangent, b.tangent);
}

TEST(Viscoelasticity, ApproachesTheBareModelAtTheNull) {
  const auto bare = model("neo_hooke");
  const auto viscous = wrapped("viscoelasticity", model("neo_hooke"));
  const std::vector<double> C = random_deformations(10, 6);
  EXPECT_LE(relative_difference(evaluate(*viscous, C, {mu, 1e-13, tau}, {}, std::vector<double>(10, 0.1)).stress,
                                evaluate(*bare, C, {mu}).stress),
            1e-12);
}

TEST(Viscoelasticity, IsTheBareModelInfinitelySlowly) {
  const auto bare = model("neo_hooke");
  const auto viscous = wrapped("viscoelasticity", model("neo_hooke"));
  const std::vector<double> C = random_deformations(3, 7);
  const auto expected = evaluate(*bare, C, {mu});
  const auto jumped = evaluate(*viscous, random_deformations(3, 8), neo_hookean, {.state = true}, {0, 0, 0});
  const std::vector<double> forever(3, std::numeric_limits<double>::infinity());
  for (const std::vector<double>& time_step : {std::vector<double>{}, forever}) {
    const auto slow = evaluate(*viscous, C, neo_hookean, {.state = true}, time_step, jumped.state);
    EXPECT_EQ(slow.stress, expected.stress);
    EXPECT_EQ(slow.tangent, expected.tangent);
    // And it forgets: a hold afterwards shows no overstress.
    EXPECT_EQ(evaluate(*viscous, C, neo_hookean, {}, {1, 1, 1}, slow.state).stress, expected.stress);
  }
}

TEST(Viscoelasticity, ATrialCommitsNothing) {
  const auto viscous = wrapped("viscoelasticity", model("neo_hooke"));
  Point tried(*viscous), untried(*viscous);
  for (Point* point : {&tried, &untried}) point->step(uniaxial_deformation(1.2), 0.5);
  const std::vector<double> once = tried.trial(uniaxial_deformation(3), 7);
  EXPECT_EQ(tried.trial(uniaxial_deformation(3), 7), once);
  EXPECT_EQ(tried.step(uniaxial_deformation(1.3), 0.5), untried.step(uniaxial_deformation(1.3), 0.5));
}

TEST(Viscoelasticity, EvaluatesABatchAsItsPoints) {
  const auto viscous = wrapped("viscoelasticity", model("neo_hooke"));
  constexpr std::size_t n = 5;
  const std::vector<double> first = random_deformations(n, 9), second = random_deformations(n, 10);
  const std::vector<double> time_step{0, 0.1, 1, 10, 100};
  const auto start = evaluate(*viscous, first, neo_hookean, {.state = true}, time_step);
  const auto batch = evaluate(*viscous, second, neo_hookean, {.state = true}, time_step, start.state);
  for (std::size_t i = 0; i < n; ++i) {
    Point point(*viscous);
    const auto at = [i](const std::vector<double>& C) {
      std::vector<double> one(6);
      for (std::size_t c = 0; c < 6; ++c) one[c] = C[c * n + i];
      return one;
    };
    point.step(at(first), time_step[i]);
    EXPECT_EQ(point.step(at(second), time_step[i]), at(batch.stress)) << "point " << i;
  }
}

TEST(Viscoelasticity, KeepsThePartsOfTheBaseAndDeclaresItsState) {
  const auto viscous = wrapped("viscoelasticity", model("hgo"));
  EXPECT_EQ(viscous->describe().history_size, 12u);
  EXPECT_FALSE(viscous->describe().parameter_derivatives);
  EXPECT_FALSE(viscous->describe().principal_axes);
  ASSERT_EQ(viscous->describe().parameters.size(), 6u);
  EXPECT_EQ(viscous->describe().parameters[4].name, "g");
  EXPECT_EQ(viscous->describe().parameters[5].name, "tau");
  EXPECT_EQ(viscous->parts().size(), 2u);
}

TEST(Viscoelasticity, SaysThatAStepHasNoParameterDerivatives) {
  const auto viscous = wrapped("viscoelasticity", model("neo_hooke"));
  std::vector<double> C = uniaxial_deformation(1.1), stress_dp(18);
  const Status status = viscous->evaluate({1, C, neo_hookean, {}, {}}, {{}, {}, {}, stress_dp, {}});
  EXPECT_EQ(status.reason(), "viscoelasticity: no parameter derivatives at a single step; difference the whole path");
}

}  // namespace
}  // namespace tunica::viscoelasticity_test
