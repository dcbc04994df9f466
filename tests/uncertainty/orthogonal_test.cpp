// SPDX-License-Identifier: Apache-2.0
#include "numerics/orthogonal.hpp"

#include <gtest/gtest.h>

namespace tunica::numerics::orthogonal_test {
namespace {

Eigen::MatrixXd nearly_alike() { return Eigen::MatrixXd{{1, 1}, {0, 1e-9}}; }

/// (0, 1) is (−1e9, 1e9) of both columns; of the first alone it is nothing.
TEST(LeastSquaresSolution, LeavesOutAColumnThatIsAnotherButForLittle) {
  const Eigen::Vector2d b(0, 1);
  EXPECT_LT(least_squares_solution(nearly_alike(), b, 1e-6).norm(), 1e-6);
  EXPECT_NEAR(least_squares_solution(nearly_alike(), b, 1e-12)[1], 1e9, 1);
  // What the first column has of b, whichever of the two is taken.
  EXPECT_NEAR(least_squares_solution(nearly_alike(), Eigen::Vector2d(3, 0), 1e-6).sum(), 3, 1e-12);
}

TEST(LeastSquaresSolution, MinimisesWhereEveryColumnCounts) {
  const Eigen::MatrixXd A{{1, 2, 0}, {0, 1, 5}, {3, -1, 1}, {2, 2, 2}};
  const Eigen::Vector4d b(1, -2, 4, 0.5);
  const Eigen::VectorXd x = least_squares_solution(A, b, 1e-6);
  EXPECT_LT((A.transpose() * (A * x - b)).norm(), 1e-12);
}

TEST(LeastSquaresSolution, IsZeroOfNothing) {
  EXPECT_EQ(least_squares_solution(Eigen::MatrixXd::Zero(3, 2), Eigen::Vector3d(1, 2, 3), 1e-6).norm(), 0);
}

TEST(OrthonormalBasis, HasAsManyColumnsAsTheRankThatIsAskedFor) {
  EXPECT_EQ(orthonormal_basis(nearly_alike(), 1e-6).cols(), 1);
  EXPECT_EQ(orthonormal_basis(nearly_alike(), 1e-12).cols(), 2);
  const Eigen::MatrixXd A{{1, 2, 3}, {0, 1, 1}, {3, -1, 2}, {2, 2, 4}};  // the third is the sum of the others
  const Eigen::MatrixXd basis = orthonormal_basis(A);
  ASSERT_EQ(basis.cols(), 2);
  EXPECT_LT((basis.transpose() * basis - Eigen::Matrix2d::Identity()).norm(), 1e-14);
  EXPECT_LT((A - basis * basis.transpose() * A).norm(), 1e-13);
}

}  // namespace
}  // namespace tunica::numerics::orthogonal_test
