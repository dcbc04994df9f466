// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace tunica::diagnosis {

/// An orthonormal basis of the columns, each first scaled to unit length. Directions shorter than `least` are left out.
Eigen::MatrixXd basis(Eigen::MatrixXd columns, double least);

/// The directions that a refit of the parameters absorbs: an orthonormal basis of the columns of J.
class Projection {
 public:
  Projection() = default;
  explicit Projection(const Eigen::MatrixXd& J);
  /// v − Q Qᵀ v
  [[nodiscard]] Eigen::MatrixXd off(const Eigen::MatrixXd& v) const;
  [[nodiscard]] Eigen::Index rank() const { return Q_.cols(); }

 private:
  Eigen::MatrixXd Q_;
};

}  // namespace tunica::diagnosis
