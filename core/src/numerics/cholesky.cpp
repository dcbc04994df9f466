// SPDX-License-Identifier: Apache-2.0
#include "numerics/cholesky.hpp"

#include <Eigen/Cholesky>

namespace tunica::numerics {

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) { return A.ldlt().solve(b); }

std::optional<Eigen::MatrixXd> half_sandwich(const Eigen::MatrixXd& H, const Eigen::MatrixXd& M) {
  const Eigen::LDLT<Eigen::MatrixXd> solver(H);
  const Eigen::LLT<Eigen::MatrixXd> root(M);
  if (solver.info() != Eigen::Success || !solver.isPositive() || root.info() != Eigen::Success) return std::nullopt;
  return solver.solve(Eigen::MatrixXd(root.matrixL()));
}

}  // namespace tunica::numerics
