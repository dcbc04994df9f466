// SPDX-License-Identifier: Apache-2.0
#include "posterior/tangent_move.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "numerics/orthogonal.hpp"

namespace tunica::posterior {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr int most_steps = 30, most_halvings = 8;          ///< of Newton's method
constexpr double precision = 1e-9, precision_back = 1e-6;  ///< of Qᵀ H
constexpr double same_place = 1e-4;                        ///< of z

/// Moves `from` to where Qᵀ H = wanted; false where Newton's method with halved steps does not come there.
bool solve(Target& target, const Matrix& basis, const Vector& wanted, double miss_allowed, Point& from) {
  Vector miss = wanted - basis.transpose() * from.rows;
  Point next;
  for (int step = 0; step < most_steps; ++step) {
    const double before = miss.norm();
    if (before < miss_allowed) return true;
    const Vector change = (basis.transpose() * from.slopes).partialPivLu().solve(miss);
    double share = 1;
    bool better = false;
    for (int halving = 0; halving < most_halvings && !better; ++halving, share /= 2) {
      if (!target.evaluate(from.z + share * change, next)) continue;
      miss = wanted - basis.transpose() * next.rows;
      better = miss.norm() < (1 - 0.1 * share) * before;
    }
    if (!better) return false;
    std::swap(from, next);
  }
  return false;
}

/// ln |det Qᵀ ∂H/∂z|.
double log_volume(const Matrix& basis, const Point& at) {
  return (basis.transpose() * at.slopes).partialPivLu().matrixLU().diagonal().array().abs().log().sum();
}

}  // namespace

double make_tangent_move(Target& target, Point& here, double size, CounterRandom& random) {
  const Vector e = random.normals(here.z.size());
  const double chance = random.uniform();  // drawn always: the numbers that follow do not depend on Newton's method
  const double kept = std::sqrt(1 - size * size);
  const Matrix basis = numerics::orthonormal_basis(here.slopes);
  Point there = here;
  if (!solve(target, basis, kept * (basis.transpose() * here.rows) + size * e, precision, there)) return 0;
  if (!std::isfinite(there.log_density)) return 0;  // a constraint is broken
  const Matrix basis_there = numerics::orthonormal_basis(there.slopes);
  const Vector wanted_back = basis_there.transpose() * here.rows;
  const Vector e_back = (wanted_back - kept * (basis_there.transpose() * there.rows)) / size;
  // ln p(z') q(z|z')/(p(z) q(z'|z))
  const double gain = there.log_density - here.log_density + 0.5 * (e.squaredNorm() - e_back.squaredNorm()) +
                      log_volume(basis_there, here) - log_volume(basis, there);
  const double probability = std::isnan(gain) ? 0 : std::min(1.0, std::exp(gain));
  if (!(chance < probability)) return probability;
  Point back = there;
  if (!solve(target, basis_there, wanted_back, precision_back, back) || (back.z - here.z).norm() > same_place) return 0;
  std::swap(here, there);
  return probability;
}

}  // namespace tunica::posterior
