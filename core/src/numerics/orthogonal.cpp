// SPDX-License-Identifier: Apache-2.0
#include "numerics/orthogonal.hpp"

#include <Eigen/QR>

namespace tunica::numerics {

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& A, std::optional<double> least) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  if (least) qr.setThreshold(*least);
  return qr.householderQ() * Eigen::MatrixXd::Identity(A.rows(), qr.rank());
}

Eigen::VectorXd least_squares_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double least) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  qr.setThreshold(least);
  // A P = Q R: P⁻¹ x = (R₁⁻¹ (Qᵀ b)₁, 0) with as many rows as the rank. Eigen's own solve() knows no threshold.
  const Eigen::Index rank = qr.rank();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(A.cols());
  x.head(rank) = qr.matrixQR()
                     .topLeftCorner(rank, rank)
                     .triangularView<Eigen::Upper>()
                     .solve((qr.householderQ().transpose() * b).head(rank));
  return qr.colsPermutation() * x;
}

Eigen::VectorXd shortest_least_squares_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& A) { return A.completeOrthogonalDecomposition().pseudoInverse(); }

Eigen::VectorXd rotated(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(A).householderQ().transpose() * b;
}

Triangular triangular(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
  const Eigen::VectorXd q = qr.householderQ().transpose() * b;
  return {qr.matrixQR().topRows(A.cols()).triangularView<Eigen::Upper>(), q.head(A.cols())};
}

}  // namespace tunica::numerics
