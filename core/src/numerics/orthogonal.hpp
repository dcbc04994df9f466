// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Core>

/// Least squares and bases by Householder reflections.
namespace tunica::numerics {

/// An orthonormal basis of the columns of A, rows × rank, by QR with column pivoting. `least`: pivots below this share
/// of the largest count as zero; none: below rounding.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& A, std::optional<double> least = {});

/// argmin |A x − b|; columns beyond the rank take no part. `least` as above.
Eigen::VectorXd least_squares_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double least);

/// The shortest of all minimisers of |A x − b|.
Eigen::VectorXd shortest_least_squares_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The Moore–Penrose inverse.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& A);

/// Qᵀ b of A = Q R: first the columns of A, then what is orthogonal to them.
Eigen::VectorXd rotated(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// A x ≈ b with n columns, brought to R x = q: R is n × n, upper triangular, q the first n entries of Qᵀ b.
struct Triangular {
  Eigen::MatrixXd R;
  Eigen::VectorXd q;
};
Triangular triangular(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace tunica::numerics
