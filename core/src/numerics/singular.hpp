// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace tunica::numerics {

/// Of A = U diag(values) Vᵀ, by Jacobi rotations: singular values, falling, and a full basis of singular vectors.
struct SingularVectors {
  Eigen::VectorXd values;   ///< min(rows, columns)
  Eigen::MatrixXd vectors;  ///< square; the first belong to the values
};
SingularVectors left_singular_vectors(const Eigen::MatrixXd& A);   ///< U
SingularVectors right_singular_vectors(const Eigen::MatrixXd& A);  ///< V

}  // namespace tunica::numerics
