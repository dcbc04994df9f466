// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace tunica::numerics {

/// Of a symmetric matrix: eigenvalues, rising, and their unit eigenvectors as columns.
struct Eigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
Eigenpairs eigenpairs(const Eigen::MatrixXd& symmetric);

}  // namespace tunica::numerics
