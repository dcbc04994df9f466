// SPDX-License-Identifier: Apache-2.0
#include "element.hpp"

#include <gtest/gtest.h>

#include "curve.hpp"
#include "mesh.hpp"

namespace tunica::testing::element_test {
namespace {

template <class T>
class FiniteElement : public ::testing::Test {};
using Orders = ::testing::Types<fe::Element<1>, fe::Element<2>>;
TYPED_TEST_SUITE(FiniteElement, Orders);

/// Every polynomial ξ^a η^b that the element holds, and its slopes, from its nodal values.
TYPED_TEST(FiniteElement, ReproducesPolynomialsOfItsOrder) {
  const TypeParam element;
  const auto node = [](std::size_t i) { return -1 + 2. * static_cast<double>(i) / TypeParam::order; };
  const auto power = [](double x, int n) { return n < 0 ? 0 : std::pow(x, n); };
  for (int a = 0; a <= static_cast<int>(TypeParam::order); ++a)
    for (int b = 0; b <= static_cast<int>(TypeParam::order); ++b)
      for (std::size_t g = 0; g < TypeParam::points; ++g) {
        double value = 0, by_xi = 0, by_eta = 0;
        for (std::size_t k = 0; k < TypeParam::nodes; ++k) {
          const double at = power(node(k % TypeParam::side), a) * power(node(k / TypeParam::side), b);
          value += element.shape[g][k] * at;
          by_xi += element.by_xi[g][k] * at;
          by_eta += element.by_eta[g][k] * at;
        }
        const double x = element.xi[g], y = element.eta[g];
        EXPECT_NEAR(value, power(x, a) * power(y, b), 1e-14);
        EXPECT_NEAR(by_xi, a * power(x, a - 1) * power(y, b), 1e-14);
        EXPECT_NEAR(by_eta, b * power(x, a) * power(y, b - 1), 1e-14);
      }
}

/// Gauss's rule of n points is exact up to degree 2n − 1.
TYPED_TEST(FiniteElement, IntegratesWhatGaussPromises) {
  const TypeParam element;
  const int exact = 2 * static_cast<int>(TypeParam::points_1d) - 1;
  const auto integral = [](int n) { return n % 2 == 1 ? 0 : 2. / (n + 1); };
  for (int a = 0; a <= exact; ++a)
    for (int b = 0; b <= exact; ++b) {
      double sum = 0;
      for (std::size_t g = 0; g < TypeParam::points; ++g)
        sum += element.weight[g] * std::pow(element.xi[g], a) * std::pow(element.eta[g], b);
      EXPECT_NEAR(sum, integral(a) * integral(b), 1e-14) << a << ", " << b;
    }
}

TYPED_TEST(FiniteElement, HasPressureModesOneXiEta) {
  const TypeParam element;
  ASSERT_EQ(TypeParam::modes, TypeParam::order == 1 ? 1u : 3u);
  for (std::size_t g = 0; g < TypeParam::points; ++g) {
    EXPECT_EQ(element.mode[g][0], 1);
    if constexpr (TypeParam::modes == 3) {
      EXPECT_EQ(element.mode[g][1], element.xi[g]);
      EXPECT_EQ(element.mode[g][2], element.eta[g]);
    }
  }
}

TEST(FiniteElementMesh, IsGradedTowardsTheEndAndNumberedAcross) {
  const fe::Mesh mesh(2, 3, 5, 2, 5, 7, 1.5, fe::Ends::clamped);
  ASSERT_EQ(mesh.planes(), 11u);
  EXPECT_EQ(mesh.nodes(), 77u);
  EXPECT_EQ(mesh.node(3, 2), 17u);
  EXPECT_DOUBLE_EQ(mesh.radius(0), 2);
  EXPECT_DOUBLE_EQ(mesh.radius(6), 5);
  EXPECT_DOUBLE_EQ(mesh.layer.front(), 0);
  EXPECT_DOUBLE_EQ(mesh.half_length(), 7);
  for (std::size_t e = 0; e < 5; ++e) {
    EXPECT_NEAR(mesh.layer[2 * e], 7 * (1 - std::pow(1 - 0.2 * static_cast<double>(e), 1.5)), 1e-14);
    EXPECT_NEAR(mesh.layer[2 * e + 1], 0.5 * (mesh.layer[2 * e] + mesh.layer[2 * e + 2]), 1e-14);
  }
  for (std::size_t e = 1; e < 5; ++e)
    EXPECT_LT(mesh.layer[2 * e + 2] - mesh.layer[2 * e], mesh.layer[2 * e] - mesh.layer[2 * e - 2]);
}

TEST(ChebyshevCurve, ReproducesPolynomialsBetweenItsPointsAndAtThem) {
  const fe::Chebyshev curve(-2, 5, 8);
  ASSERT_TRUE(std::is_sorted(curve.points().begin(), curve.points().end()));
  EXPECT_EQ(curve.points().front(), -2);
  EXPECT_EQ(curve.points().back(), 5);
  const auto f = [](double x) { return 3 + x * (1 - x * (2 + x * x * x * (0.1 + x * x * 0.01))); };  // degree 7
  std::vector<double> weights(8);
  for (const double x : {-2., -1.3, 0., curve.points()[3], 4.99, 5.}) {
    curve.weights(x, weights);
    double value = 0;
    for (std::size_t k = 0; k < 8; ++k) value += weights[k] * f(curve.points()[k]);
    EXPECT_NEAR(value, f(x), 1e-12 * 1000) << x;
  }
}

/// Of T_m of degree m < n − 3 nothing is left; of T_(n−2), its own coefficient.
TEST(ChebyshevCurve, TheTailIsTheLargestOfTheLastThreeCoefficients) {
  constexpr std::size_t n = 9;
  const fe::Chebyshev curve(-1, 1, n);
  const auto tail_of = [&](double degree, double times) {
    std::vector<double> values;
    for (const double x : curve.points())
      values.push_back(times * std::cos(degree * std::acos(std::clamp(x, -1., 1.))));
    return curve.tail(values);
  };
  EXPECT_NEAR(tail_of(5, 4), 0, 1e-14);
  EXPECT_NEAR(tail_of(6, 4), 4, 1e-13);
  EXPECT_NEAR(tail_of(7, -3), 3, 1e-13);
}

}  // namespace
}  // namespace tunica::testing::element_test
