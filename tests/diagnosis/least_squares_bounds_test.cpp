// SPDX-License-Identifier: Apache-2.0
// Steps at bounds, of two parameters: y = a + x + c x² at four rows, a from 0 to 10 and c from −5 to 5.
#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/LU>
#include <gmock/gmock.h>

#include "calibration/fakes.hpp"
#include "diagnosis/evidence/least_squares.hpp"

namespace tunica::diagnosis {
namespace {

struct TwoParameters : fakes::Bench {
  /// Measured: y at (a, c), where no bound holds, and what no parameter follows.
  TwoParameters(std::vector<double> where, const Eigen::Vector2d& at, double sd, const Eigen::Vector4d& more)
      : x(std::move(where)) {
    run.objective = experiment::ObjectiveType::least_squares;
    std::vector<double> y;
    for (std::size_t i = 0; i < 4; ++i)
      y.push_back(at[0] + x[i] + at[1] * x[i] * x[i] + more[static_cast<Eigen::Index>(i)]);
    add_test("t", x, y).data.noise = {{"y", {sd, 0, 0}}};
    parameter("b").fixed = 1;
    J.resize(4, 2);
    for (Eigen::Index i = 0; i < 4; ++i) {
      const double square = std::pow(x[static_cast<std::size_t>(i)], 2);
      J.row(i) << 10 / sd, 10 * square / sd;  // in the unit box
      measured[i] = (y[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(i)]) / sd;
    }
  }
  [[nodiscard]] Eigen::Vector4d residuals(const Eigen::Vector2d& unit) const {
    return J * (unit - Eigen::Vector2d(0, 0.5)) - measured;
  }
  /// What a step to there promises.
  [[nodiscard]] double promise(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
    return residuals(from).squaredNorm() - residuals(to).squaredNorm();
  }
  /// The step of all parameters, or of one alone, cut off at the bounds.
  [[nodiscard]] Eigen::Vector2d stepped(const Eigen::Vector2d& from, double damping,
                                        std::optional<int> alone = {}) const {
    Eigen::Matrix2d normal = J.transpose() * J;
    normal.diagonal() *= 1 + damping;
    const Eigen::Vector2d g = J.transpose() * residuals(from);
    Eigen::Vector2d step = normal.inverse() * -g;
    if (alone) step = Eigen::Vector2d::Unit(*alone) * -g[*alone] / normal(*alone, *alone);
    return (from + step).cwiseMax(0).cwiseMin(1);
  }
  /// Where it is after so many evaluations, in the unit box.
  Eigen::Vector2d after(const Eigen::Vector2d& from, std::size_t evaluations) {
    const auto assembly = assemble();
    const Fit found = least_squares(assembly, {{0}, {1}}, std::vector<double>{10 * from[0], 10 * from[1] - 5},
                                    *assembly.evaluator().make_workspace(), evaluations);
    return {found.free[0] / 10, found.free[1] / 10 + 0.5};
  }
  std::vector<double> x;
  Eigen::Matrix<double, 4, 2> J;
  Eigen::Vector4d measured;
};

constexpr double a_bit = 1e-10;

// Both from the upper and from the lower bound of a; pressed against it by a gradient that is large or small.
TEST(StepsAtABound, AreOfTheOthersWhereTheGradientPressesAgainstIt) {
  for (const double beyond : {3.0, 1e-3})
    for (const bool upper : {true, false}) {
      const double bound = upper ? 10 : 0, sd = beyond > 1 ? 0.1 : 0.3;
      // The rows of c have x² = 1, so that the gradient by a is what c = 0.2 and a leave of them.
      TwoParameters bench({0, 0, 0, 1}, {bound + (upper ? beyond : -beyond), 0.2}, sd, Eigen::Vector4d::Zero());
      const Eigen::Vector2d from(bound / 10, 0.52);
      const double gradient = (bench.J.transpose() * bench.residuals(from))[0];
      ASSERT_EQ(gradient < 0, upper);
      const Eigen::Vector2d expected = bench.stepped(from, 1e-4, 1);
      ASSERT_GT(bench.promise(from, expected), 1e-6);
      EXPECT_LT((bench.after(from, 2) - expected).norm(), a_bit) << beyond << upper;
    }
}

TEST(StepsAtABound, LeaveItWhereTheGradientLeadsInside) {
  for (const double inside : {3.0, 1e-3})
    for (const bool upper : {true, false}) {
      const double bound = upper ? 10 : 0;
      TwoParameters bench({0, 0, 0, 1}, {bound + (upper ? -inside : inside), 0.2}, 0.3, Eigen::Vector4d::Zero());
      const Eigen::Vector2d from(bound / 10, 0.52);
      const Eigen::Vector2d expected = bench.stepped(from, 1e-4);
      ASSERT_GT(bench.promise(from, expected), 1e-6);
      EXPECT_LT((bench.after(from, 2) - expected).norm(), a_bit) << inside << upper;
    }
}

// Columns that are nearly alike: the step is far out, and cut off it leads up. Ten times the damping, until it does
// not.
TEST(StepsThatBoundsCutOff, AreDampedUntilTheyLeadDown) {
  TwoParameters bench({1, 1.02, 1.04, 1.06}, {-30, 32}, 0.01, Eigen::Vector4d::Zero());
  const Eigen::Vector2d from(0.3, 0.6);
  double damping = 1e-4;
  while (bench.promise(from, bench.stepped(from, damping)) <= 0) damping *= 10;
  ASSERT_GE(damping, 1e-2 * 0.99);
  EXPECT_LT((bench.after(from, 2) - bench.stepped(from, damping)).norm(), a_bit) << damping;
}

TEST(StepsAtABound, EndAndGoOnFromThere) {
  // From the optimum beyond it, then from there.
  TwoParameters bench({0, 0.5, 1, 2}, {14, 1}, 0.1, {0.1, -0.1, 0.05, 0});
  const Eigen::Vector2d from(0.7, 0.5), first = bench.stepped(from, 1e-4);
  ASSERT_EQ(first[0], 1);
  ASSERT_GT(bench.promise(from, first), 0);
  EXPECT_LT((bench.after(from, 2) - first).norm(), a_bit);
  // It ends where c is the best beside a = 10.
  const double g = bench.J.col(1).dot(bench.residuals({1, 0.5})), best = 0.5 - g / bench.J.col(1).squaredNorm();
  EXPECT_LT((bench.after(from, 200) - Eigen::Vector2d(1, best)).norm(), 1e-5);
}

}  // namespace
}  // namespace tunica::diagnosis
