// SPDX-License-Identifier: Apache-2.0
#include "search/constrained_step.hpp"

#include <algorithm>
#include <vector>

#include "numerics/orthogonal.hpp"

namespace tunica::search {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Eigen::Index;

/// min ‖E u − f‖, u ≥ 0.
Vector non_negative_least_squares(const Matrix& E, const Vector& f) {
  const Index m = E.cols();
  Vector u = Vector::Zero(m);
  std::vector<bool> passive(static_cast<std::size_t>(m), false);
  const auto free = [&](Index i) { return passive[static_cast<std::size_t>(i)]; };
  for (Index round = 0; round < 3 * m + 10; ++round) {
    const Vector w = E.transpose() * (f - E * u);
    Index enters = -1;
    for (Index i = 0; i < m; ++i)
      if (!free(i) && w[i] > 1e-12 && (enters < 0 || w[i] > w[enters])) enters = i;
    if (enters < 0) break;
    passive[static_cast<std::size_t>(enters)] = true;
    for (;;) {
      std::vector<Index> at;
      for (Index i = 0; i < m; ++i)
        if (free(i)) at.push_back(i);
      if (at.empty()) break;
      const Vector z = numerics::shortest_least_squares_solution(E(Eigen::all, at), f);
      double share = 1;
      for (std::size_t k = 0; k < at.size(); ++k)
        if (const double to = z[static_cast<Index>(k)]; to <= 0) share = std::min(share, u[at[k]] / (u[at[k]] - to));
      for (std::size_t k = 0; k < at.size(); ++k) {
        u[at[k]] += share * (z[static_cast<Index>(k)] - u[at[k]]);
        if (z[static_cast<Index>(k)] > 0 || u[at[k]] > 1e-14) continue;
        u[at[k]] = 0;
        passive[static_cast<std::size_t>(at[k])] = false;
      }
      if (share == 1) break;
    }
  }
  return u;
}

}  // namespace

std::optional<ConstrainedStep> constrained_step(const Matrix& J, const Vector& r, const Matrix& A, const Vector& c) {
  constexpr double ridge = 1e-3;
  const Index n = J.cols(), rows = J.rows(), m = A.rows();
  Matrix stacked(rows + n, n);
  stacked << J, ridge * Matrix::Identity(n, n);
  Vector right = Vector::Zero(rows + n);
  right.head(rows) = -r;
  const auto [upper, q] = numerics::triangular(stacked, right);
  const auto R = upper.triangularView<Eigen::Upper>();
  // With z = R s − q the objective is ‖z‖² and a constant, and the inequalities G z ≥ h.
  Matrix G = -R.transpose().solve(A.transpose()).transpose();
  Vector h = c - G * q;
  Vector length = G.rowwise().norm();
  for (Index i = 0; i < m; ++i) {
    if (!(length[i] > 0)) length[i] = 1;
    G.row(i) /= length[i];
    h[i] /= length[i];
  }
  const double scale = std::max(h.size() > 0 ? h.cwiseAbs().maxCoeff() : 0.0, 1e-12);
  Matrix E(n + 1, m);
  E << G.transpose(), h.transpose() / scale;
  const Vector u = non_negative_least_squares(E, Vector::Unit(n + 1, n));
  const Vector rest = E * u - Vector::Unit(n + 1, n);
  if (rest.norm() < 1e-7) return {};
  const Vector z = -scale * rest.head(n) / rest[n];
  ConstrainedStep found{R.solve(z + q), 0};
  for (Index i = 0; i < m; ++i)
    found.largest_multiplier = std::max(found.largest_multiplier, 2 * scale * u[i] / (-rest[n] * length[i]));
  return found;
}

}  // namespace tunica::search
