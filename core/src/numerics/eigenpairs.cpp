// SPDX-License-Identifier: Apache-2.0
#include "numerics/eigenpairs.hpp"

#include <Eigen/Eigenvalues>

namespace tunica::numerics {

Eigenpairs eigenpairs(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace tunica::numerics
