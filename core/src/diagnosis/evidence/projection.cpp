// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/projection.hpp"

#include <algorithm>

#include "numerics/orthogonal.hpp"

namespace tunica::diagnosis {

Eigen::MatrixXd basis(Eigen::MatrixXd columns, double least) {
  Eigen::Index kept = 0;
  double longest = 0;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) longest = std::max(longest, columns.col(k).norm());
  for (Eigen::Index k = 0; k < columns.cols(); ++k)
    if (const double length = columns.col(k).norm(); length > 1e-12 * longest && length > 0)
      columns.col(kept++) = (columns.col(k) / length).eval();
  if (kept == 0) return Eigen::MatrixXd(columns.rows(), 0);
  return numerics::orthonormal_basis(columns.leftCols(kept), least);
}

Projection::Projection(const Eigen::MatrixXd& J) : Q_(basis(J, 1e-8)) {}

Eigen::MatrixXd Projection::off(const Eigen::MatrixXd& v) const {
  if (Q_.cols() == 0) return v;
  // Twice, for orthogonality to the last digits.
  Eigen::MatrixXd left = v - Q_ * (Q_.transpose() * v);
  left -= Q_ * (Q_.transpose() * left);
  return left;
}

}  // namespace tunica::diagnosis
