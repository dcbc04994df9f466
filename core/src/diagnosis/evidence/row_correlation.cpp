// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/row_correlation.hpp"

#include <cmath>
#include <vector>

#include "assembly/restricted_variance.hpp"

namespace tunica::diagnosis {
namespace {

/// Whether a row and the next are neighbours of one curve whose noise is estimated.
std::vector<bool> pairs_of(const Evidence& evidence) {
  const std::vector<std::size_t>& group = evidence.estimated.group;
  std::vector<bool> pair(group.size(), false);
  for (const Curve& curve : evidence.curves)
    for (Eigen::Index i = 0; i + 1 < curve.count; ++i) {
      const auto row = static_cast<std::size_t>(curve.first + i), k = static_cast<std::size_t>(i);
      pair[row] = group[row] != assembly::known_variance && group[row + 1] != assembly::known_variance &&
                  curve.rows[k + 1] == curve.rows[k] + 1;
    }
  return pair;
}

/// M v, column by column.
Eigen::MatrixXd among_neighbours(const std::vector<bool>& pair, const Eigen::MatrixXd& v) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(v.rows(), v.cols());
  for (Eigen::Index i = 0; i + 1 < v.rows(); ++i)
    if (pair[static_cast<std::size_t>(i)]) {
      result.row(i) += v.row(i + 1) / 2;
      result.row(i + 1) += v.row(i) / 2;
    }
  return result;
}

}  // namespace

std::optional<RowCorrelation> row_correlation(const Evidence& evidence, const Fit& fit) {
  const Eigen::MatrixXd& Q = evidence.estimated.span;
  if (Q.cols() == 0) return std::nullopt;
  const std::vector<bool> pair = pairs_of(evidence);
  const Eigen::Index n = Q.rows();
  Eigen::VectorXd D = Eigen::VectorXd::Zero(n);
  double pairs = 0;
  for (Eigen::Index i = 0; i + 1 < n; ++i)
    if (pair[static_cast<std::size_t>(i)]) {
      D[i] = D[i + 1] = 1;
      pairs += 1;
    }
  const Eigen::MatrixXd MQ = among_neighbours(pair, Q);
  const double left = D.sum() - (D.asDiagonal() * Q).squaredNorm();
  if (!(left > 1)) return std::nullopt;
  const double c = -Q.cwiseProduct(MQ).sum() / left;
  const Eigen::MatrixXd KQ = MQ - c * (D.asDiagonal() * Q);
  const double spread = (pairs / 2 + c * c * D.sum()) - 2 * KQ.squaredNorm() + (Q.transpose() * KQ).squaredNorm();
  if (!(spread > 0.5)) return std::nullopt;
  const Eigen::VectorXd e = fit.residuals - Q * (Q.transpose() * fit.residuals);
  const Eigen::VectorXd Ke = among_neighbours(pair, e) - c * D.cwiseProduct(e);
  return RowCorrelation{e.dot(Ke) / (2 * spread), 1 / std::sqrt(2 * spread)};
}

}  // namespace tunica::diagnosis
