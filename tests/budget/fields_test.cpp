// SPDX-License-Identifier: Apache-2.0
// How large a misfit of a field is, and which smooth shapes it may have.
#include <cmath>
#include <vector>

#include <gmock/gmock.h>

#include "assembly/field_shapes.hpp"
#include "assembly/misfit_size.hpp"

namespace tunica::assembly {
namespace {

using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;

/// Points of a grid over [−1, 1]² in steps at −1, 0 and 1.
struct Grid {
  std::vector<double> x, y, step;
  explicit Grid(int points) {
    for (int k = -1; k <= 1; ++k)
      for (int i = 0; i < points; ++i)
        for (int j = 0; j < points; ++j) {
          x.push_back(2.0 * i / (points - 1) - 1);
          y.push_back(2.0 * j / (points - 1) - 1);
          step.push_back(k);
        }
  }
};

TEST(FieldShapes, AreProductsOfPolynomialsAlongBothAxesAndTheStep) {
  const Grid grid(5);
  const auto [columns, degree] = field_shapes(grid.x, grid.y, grid.step, 2);
  // Degree 0: 1. Degree 1: y, x, step. Degree 2: y², xy, x², y·step, x·step, step².
  EXPECT_THAT(degree, ElementsAre(0, 1, 1, 1, 2, 2, 2, 2, 2, 2));
  const auto half = [](double u) { return 1.5 * u * u - 0.5; };
  // Three of mean square ⅓ have the mean square of one, ⅓, where each is 1/√3 as high. Of degree 2 there are three of
  // mean square 1/5 and three of 1/9.
  const double first = 1 / std::sqrt(3.0), second = 1 / std::sqrt(5 * (3.0 / 5 + 3.0 / 9));
  for (std::size_t i = 0; i < grid.x.size(); ++i) {
    const double x = grid.x[i], y = grid.y[i], t = grid.step[i];
    const std::vector<double> expected{1,
                                       first * y,
                                       first * x,
                                       first * t,
                                       second * half(y),
                                       second * x * y,
                                       second * half(x),
                                       second * y * t,
                                       second * x * t,
                                       second * half(t)};
    for (std::size_t c = 0; c < expected.size(); ++c)
      EXPECT_THAT(columns(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)), DoubleNear(expected[c], 1e-14));
  }
}

TEST(FieldShapes, AreAsManyAsAThirdOfTheRowsAtMost) {
  const Grid grid(3);
  EXPECT_EQ(field_shapes(grid.x, grid.y, grid.step, 14).columns.cols(), 9);
}

TEST(FieldShapes, OfOneStepDependOnPlacesOnly) {
  Grid grid(7);
  for (double& step : grid.step) step = 3;
  const auto [columns, degree] = field_shapes(grid.x, grid.y, grid.step, 2);
  EXPECT_THAT(degree, ElementsAre(0, 1, 1, 2, 2, 2));
  EXPECT_TRUE(columns.allFinite());
}

TEST(MisfitSize, CountsAFieldAsOneRowAStep) {
  // 100 points over two steps that miss by 0.1 % of their range, and two forces that miss by 10 %.
  const std::vector<double> points(100, 1e-4), forces(2, 1);
  const MisfitSize size(
      {{"plate", "ux", "mm", 1, {points, {}, false, 0}, 2}, {"plate", "force", "mN", 100, {forces, {}, false, 0}, 2}});
  Eigen::VectorXd r(102);
  r << Eigen::VectorXd::Constant(100, 10), 10, 10;
  // √((2 · 0.001² + 2 · 0.1²)/4), and of |r|² = 102 · 100 the part beyond ν = 102.
  const double beyond = std::sqrt(1 - 102 / (102 * 100.0));
  EXPECT_THAT(size.of(r, 0).rms, DoubleNear(beyond * std::sqrt((1e-6 + 1e-2) / 2), 1e-12));
  EXPECT_EQ(over_rows(size.channels(r, 0), {0.02, 0.02}), 0.02);
}

TEST(CountedRows, AreTheStepsOfAFieldAndTheRowsOfForces) {
  MeasuredChannel view;
  view.count = 5;
  view.abscissa_name = "step";
  view.abscissa = {1, 1, 2, 1, 2};
  view.fitted = {true, true, true, true, false};
  EXPECT_EQ(counted_rows(view), 4) << "no field";
  view.other_abscissae = {{"x [mm]", {0, 1, 0, NAN, NAN}}, {"y [mm]", {0, 0, 1, NAN, NAN}}};
  EXPECT_EQ(counted_rows(view), 3) << "two steps with points, and a force";
  EXPECT_THAT((std::vector{view.is_point(0), view.is_point(2)}), Each(true));
  EXPECT_FALSE(view.is_point(3));
}

}  // namespace
}  // namespace tunica::assembly
