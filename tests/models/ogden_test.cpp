// SPDX-License-Identifier: Apache-2.0
// Ogden's model where it is something else in closed form, and the tangent where principal stretches come together.
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"
#include "support/loaded.hpp"

namespace tunica::testing {
using namespace conformance;
namespace {

using Matrix = Eigen::Matrix3d;

Options with_terms(std::int64_t terms) {
  Options options;
  options.set("terms", terms);
  return options;
}

Matrix to_matrix(const Tensor& C) {
  Matrix m;
  m << C[0], C[3], C[5], C[3], C[1], C[4], C[5], C[4], C[2];
  return m;
}
Tensor to_tensor(const Matrix& m) { return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)}; }

/// The symmetric part of a ⊠ b: component (ij, kl) of ½ (a_ik b_jl + a_il b_jk), so that X ↦ a X b for symmetric X.
double square_product(const Matrix& a, const Matrix& b, std::size_t row, std::size_t column) {
  constexpr std::array<std::array<int, 2>, 6> place{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  const auto [i, j] = place[row];
  const auto [k, l] = place[column];
  return 0.25 * (a(i, k) * b(j, l) + a(i, l) * b(j, k) + a(j, k) * b(i, l) + a(j, l) * b(i, k));
}

TEST(Ogden, IsNeoHookeWithOneTermOfExponentTwo) {
  const auto ogden = make_model("ogden", with_terms(1)), neo_hooke = make_model("neo_hooke");
  Sampler sampler(9);
  for (int draw = 0; draw < 20; ++draw) {
    const Tensor C = sampler.right_cauchy_green();
    const Evaluated one = evaluate(*ogden, C, std::vector<double>{25, 2}),
                    other = evaluate(*neo_hooke, C, std::vector<double>{25});
    EXPECT_NEAR(one.energy, other.energy, 1e-12);
    for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(one.stress[c], other.stress[c], 1e-11);
    for (std::size_t c = 0; c < 36; ++c) EXPECT_NEAR(one.tangent[c], other.tangent[c], 1e-9);
  }
}

/// For exponents 6 and −2 everything is rational in C: W = Σ μ/α (tr C^{α/2} − 3), hence S = μ C² for 6, and for −2
/// S = μ C⁻²; the tangents are 2 μ (C ⊠ 1 + 1 ⊠ C) and −2 μ (C⁻¹ ⊠ C⁻² + C⁻² ⊠ C⁻¹).
void expect_rational_tangent(const Matrix& C, double tolerance) {
  const auto model = make_model("ogden", with_terms(2));
  const double mu_6 = 3, mu_2 = -7;
  const Evaluated at = evaluate(*model, to_tensor(C), std::vector<double>{mu_6, 6, mu_2, -2});
  const Matrix one = Matrix::Identity(), inverse = C.inverse(), inverse2 = inverse * inverse;
  const Tensor stress = to_tensor(mu_6 * C * C + mu_2 * inverse2);
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(at.stress[c], stress[c], tolerance) << c;
  for (std::size_t row = 0; row < 6; ++row)
    for (std::size_t column = 0; column < 6; ++column) {
      const double expected =
          2 * mu_6 * (square_product(C, one, row, column) + square_product(one, C, row, column)) -
          2 * mu_2 * (square_product(inverse, inverse2, row, column) + square_product(inverse2, inverse, row, column));
      EXPECT_NEAR(at.tangent[6 * row + column], expected, tolerance) << row << " " << column;
    }
}

TEST(Ogden, StressAndTangentAreTheRationalOnesForRationalExponents) {
  Sampler sampler(10);
  for (int draw = 0; draw < 20; ++draw) {
    const Matrix C = to_matrix(sampler.right_cauchy_green());
    expect_rational_tangent(C, 1e-10 * (C.norm() + std::pow(C.inverse().norm(), 3)));
  }
}

TEST(Ogden, TangentIsExactWherePrincipalStretchesComeTogether) {
  // Two or three equal squared stretches, and gaps through 16 decades, in a turned frame: no step, no loss of digits.
  const Matrix Q = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
  for (const double gap : {0., 1e-16, 1e-15, 1e-13, 1e-11, 1e-9, 1e-7, 1e-5, 1e-3, 1e-2, 0.09, 0.1, 0.11, 0.3})
    for (const double third : {0., 1., 3.}) {
      const Eigen::Vector3d c(1.5, 1.5 * (1 + gap), 1.5 * (1 + third * gap));
      expect_rational_tangent(Q * c.asDiagonal() * Q.transpose(), 2e-12 * 40);
    }
}

TEST(Ogden, HasItsLogarithmicLimitAtExponentZero) {
  const auto model = make_model("ogden", with_terms(1));
  const Tensor C{1.5, 0.8, 1.1, 0.1, 0, 0.05};
  const double det = to_matrix(C).determinant();
  const Matrix inverse = to_matrix(C).inverse();
  for (const double alpha : {0., 1e-9}) {
    const Evaluated at = evaluate(*model, C, std::vector<double>{4, alpha});
    EXPECT_NEAR(at.energy, 2 * std::log(det), 1e-7);  // μ ln J
    for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(at.stress[c], 4 * to_tensor(inverse)[c], 1e-7);
  }
}

TEST(Ogden, HasTwoParametersForEachTerm) {
  for (const std::int64_t terms : {1, 2, 3, 4, 5, 6}) {
    const auto model = make_model("ogden", with_terms(terms));
    const auto& parameters = model->describe().parameters;
    ASSERT_EQ(parameters.size(), static_cast<std::size_t>(2 * terms));
    EXPECT_EQ(parameters[parameters.size() - 2].name, "mu_" + std::to_string(terms));
    EXPECT_EQ(parameters.back().name, "alpha_" + std::to_string(terms));
  }
}

TEST(Ogden, ATensorThatIsNotPositiveGivesNonFiniteNumbers) {
  const auto model = make_model("ogden");
  const std::vector<double> p{630, 1.3, 1.2, 5, -10, -2};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Tensor& C : {Tensor{-1, 1, 1, 0, 0, 0}, Tensor{nan, 1, 1, 0, 0, 0}}) {
    const Evaluated at = evaluate(*model, C, p);
    EXPECT_FALSE(std::isfinite(at.energy));
    EXPECT_FALSE(std::isfinite(at.stress[0]));
  }
}

}  // namespace
}  // namespace tunica::testing
