// SPDX-License-Identifier: Apache-2.0
#include "numerics/singular.hpp"

#include <Eigen/SVD>

namespace tunica::numerics {

SingularVectors left_singular_vectors(const Eigen::MatrixXd& A) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullU);
  return {svd.singularValues(), svd.matrixU()};
}

SingularVectors right_singular_vectors(const Eigen::MatrixXd& A) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace tunica::numerics
