// SPDX-License-Identifier: Apache-2.0
#include "edge_fit.hpp"

namespace tunica::field {

void EdgeFit::linearise(Equilibrium& body) {
  du_.resize(modes_.size());
  df_.resize(modes_.size());
  Eigen::MatrixXd G;
  for (std::size_t k = 0; k < modes_.size(); ++k) {
    body.by_edge(modes_[k], du_[k], df_[k]);
    const Eigen::VectorXd read = reading_(du_[k]);
    if (k == 0) G.resize(read.size(), static_cast<Eigen::Index>(modes_.size()));
    G.col(static_cast<Eigen::Index>(k)) = read;
  }
  G_.compute(G);
}

/// By the triangle of G, since a damping is tried after another (Moré, Lecture Notes in Mathematics 630:105, 1978).
Eigen::VectorXd EdgeFit::solve(const Eigen::VectorXd& rest, double damping) const {
  if (damping == 0) return solve(rest);
  const Eigen::Index n = G_.cols();
  const Eigen::MatrixXd R = G_.matrixR().topRows(n).triangularView<Eigen::Upper>();
  Eigen::MatrixXd stacked(2 * n, n);
  stacked << R, Eigen::MatrixXd::Identity(n, n) * (damping * R.colwise().norm().maxCoeff());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * n);
  right.head(n) = Eigen::VectorXd(G_.householderQ().adjoint() * rest).head(n);
  return G_.colsPermutation() * stacked.householderQr().solve(right).eval();
}

void EdgeFit::add(const Eigen::VectorXd& coefficients, std::vector<double>& prescribed) const {
  for (std::size_t k = 0; k < modes_.size(); ++k)
    for (const auto& [dof, value] : modes_[k]) prescribed[dof] += coefficients[static_cast<Eigen::Index>(k)] * value;
}

void EdgeFit::add(const Eigen::VectorXd& coefficients, std::vector<double>& du, std::vector<double>& df) const {
  for (std::size_t k = 0; k < modes_.size(); ++k) {
    const double by = coefficients[static_cast<Eigen::Index>(k)];
    for (std::size_t dof = 0; dof < du.size(); ++dof) {
      du[dof] += by * du_[k][dof];
      df[dof] += by * df_[k][dof];
    }
  }
}

void EdgeFit::follow(std::vector<double>& du, std::vector<double>& df) const { add(solve(-reading_(du)), du, df); }

}  // namespace tunica::field
