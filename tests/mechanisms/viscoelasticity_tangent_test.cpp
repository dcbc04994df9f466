// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "deformations.hpp"
#include "shelf.hpp"

// The overstress does not see a function of the volume in the energy, and its tangent is that of the step.
namespace tunica::viscoelasticity_tangent_test {
namespace {

using testing::evaluate;
using testing::random_deformations;
using testing::relative_difference;
using testing::wrapped;

/// W + f(J) with f = a (J − 1) + ½ b (J − 1)²: the same incompressible material, written in another gauge. It also
/// counts the steps in a state of its own.
class Regauged final : public Model {
 public:
  Regauged(std::unique_ptr<Model> base, double a, double b)
      : base_(std::move(base)), description_(base_->describe()), a_(a), b_(b) {
    description_.history_size = 1;
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    const std::size_t n = points.count;
    MaterialResponse bare = response;
    bare.state = {};
    if (Status status = base_->evaluate({n, points.C, points.parameters, {}, {}}, bare); !status.ok()) return status;
    for (std::size_t i = 0; i < n; ++i) {
      const double tt = points.C[i], zz = points.C[n + i], rr = points.C[2 * n + i];
      const double tz = points.C[3 * n + i], zr = points.C[4 * n + i], tr = points.C[5 * n + i];
      // S += f'(J) J C⁻¹; the tangent is not needed here.
      const testing::Tensor cofactors{zz * rr - zr * zr, tt * rr - tr * tr, tt * zz - tz * tz,
                                      tr * zr - tz * rr, tz * tr - tt * zr, tz * zr - tr * zz};
      const double determinant = tt * cofactors[0] + tz * cofactors[3] + tr * cofactors[5];
      const double J = std::sqrt(determinant);
      for (std::size_t c = 0; c < 6 && !response.stress.empty(); ++c)
        response.stress[c * n + i] += (a_ + b_ * (J - 1)) * J * cofactors[c] / determinant;
      if (!response.state.empty()) response.state[i] = 1 + (points.state.empty() ? 0 : points.state[i]);
    }
    return {};
  }

 private:
  std::unique_ptr<Model> base_;
  ModelDescription description_;
  double a_, b_;
};

const std::vector<double> hgo{18.7, 24.9, 0.9, 46}, with_branch{18.7, 24.9, 0.9, 46, 0.8, 5};
const std::vector<double> time_step{0, 0.2, 1, 6, 50};

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] - b[i];
  return result;
}

TEST(ViscoelasticityGauge, OverstressIgnoresAFunctionOfTheVolume) {
  const std::vector<double> first = random_deformations(5, 21), second = random_deformations(5, 22);
  const auto regauged = [] { return std::make_unique<Regauged>(testing::model("hgo"), -31.0, 55.0); };
  const auto plain = wrapped("viscoelasticity", testing::model("hgo"));
  const auto other = wrapped("viscoelasticity", regauged());
  const auto plain_start = evaluate(*plain, first, with_branch, {.state = true}, time_step);
  const auto other_start = evaluate(*other, first, with_branch, {.state = true}, time_step);
  const auto a = evaluate(*plain, second, with_branch, {}, time_step, plain_start.state);
  const auto b = evaluate(*other, second, with_branch, {}, time_step, other_start.state);
  // The equilibrium stresses differ, or the test would show nothing.
  const auto base_a = evaluate(*testing::model("hgo"), second, hgo).stress;
  const auto base_b = evaluate(*regauged(), second, hgo).stress;
  ASSERT_GT(relative_difference(base_b, base_a), 0.1);
  EXPECT_LE(relative_difference(difference(b.stress, base_b), difference(a.stress, base_a)), 1e-12);
}

TEST(ViscoelasticityGauge, KeepsTheStateOfItsBaseInFront) {
  const auto viscous = wrapped("viscoelasticity", std::make_unique<Regauged>(testing::model("hgo"), 0, 0));
  ASSERT_EQ(viscous->describe().history_size, 13u);
  const std::vector<double> C = random_deformations(5, 23);
  const auto once = evaluate(*viscous, C, with_branch, {.state = true}, time_step);
  const auto twice = evaluate(*viscous, C, with_branch, {.state = true}, time_step, once.state);
  EXPECT_EQ(std::vector<double>(twice.state.begin(), twice.state.begin() + 5), std::vector<double>(5, 2));
}

TEST(ViscoelasticityTangent, IsTheDerivativeOfTheStep) {
  const auto viscous = wrapped("viscoelasticity", testing::model("hgo", "none"));
  const std::vector<double> C = random_deformations(5, 24);
  const auto start = evaluate(*viscous, random_deformations(5, 25), with_branch, {.state = true}, time_step);
  const auto at = evaluate(*viscous, C, with_branch, {}, time_step, start.state);
  constexpr double h = 1e-5;
  std::vector<double> differences(36 * 5);
  for (std::size_t q = 0; q < 6; ++q) {
    // A shear component stands in C twice, so it moves the stress by twice its tensor derivative.
    const double count = q < 3 ? 1 : 2;
    std::vector<double> ahead = C, behind = C;
    for (std::size_t i = 0; i < 5; ++i) {
      ahead[5 * q + i] += h;
      behind[5 * q + i] -= h;
    }
    const auto plus = evaluate(*viscous, ahead, with_branch, {}, time_step, start.state).stress;
    const auto minus = evaluate(*viscous, behind, with_branch, {}, time_step, start.state).stress;
    for (std::size_t p = 0; p < 6; ++p) {
      for (std::size_t i = 0; i < 5; ++i)
        differences[(6 * p + q) * 5 + i] = 2 * (plus[5 * p + i] - minus[5 * p + i]) / (2 * h * count);
    }
  }
  EXPECT_LE(relative_difference(at.tangent, differences), 1e-8);
}

TEST(ViscoelasticityTangent, NeedsNoOtherOutput) {
  const auto viscous = wrapped("viscoelasticity", testing::model("hgo"));
  const std::vector<double> C = random_deformations(5, 26);
  std::vector<double> tangent(180);
  const Status status = viscous->evaluate({5, C, with_branch, time_step, {}}, {{}, {}, tangent, {}, {}});
  ASSERT_TRUE(status.ok()) << status.reason();
  EXPECT_EQ(tangent, evaluate(*viscous, C, with_branch, {}, time_step).tangent);
}

}  // namespace
}  // namespace tunica::viscoelasticity_tangent_test
