// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver.hpp"

namespace tunica::fe {
namespace {

constexpr double exact = 1e-9;           ///< of the adjoint
constexpr std::size_t most_passes = 12;  ///< a factor nearby takes two to four
constexpr double too_slow = 0.1;         ///< a pass that leaves more than this wants a factor of the solution

}  // namespace

/// The weights y, h of an observable a · x make its change by the equations −∂Π/∂x and c vanish at free positions:
///
///   K y − G h = a,   Gᵀ y = 0.
///
/// The axial force has no a, but y = 2π for z over the plane of symmetry, which is prescribed, as y = 0 is elsewhere.
/// What remains at prescribed rows is how the observable changes as they move. The condensed factor of a state nearby
/// solves it; its compressibility and its rounding, magnified by γ, come off by iterative refinement. With the
/// residuals r = a − K y + G h and g = Gᵀ y that is
///
///   (K + γ G M⁻¹ Gᵀ) dy = r − γ G M⁻¹ g,   dh = −γ M⁻¹ (g + Gᵀ dy).
///
/// Source: N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., SIAM (2002), chapter 12.
Status Solver::weigh(const Load& load, const State& state, std::span<const std::size_t> positions, bool axial_force,
                     std::vector<Weights>& weights, Changes& changes) {
  const std::size_t count = positions.size() + (axial_force ? 1 : 0);
  assembly_->by_volume(state, system_.volume);  // by_pressure() of the solution itself, too
  begin_adjoint(positions, axial_force);
  double last = 1;
  bool own_factor = false;
  for (std::size_t pass = 0;; ++pass) {
    double step = 0;
    if (Status status = refine_adjoint(load, state, positions, pass == 0 ? &changes : nullptr, step); !status.ok())
      return status;
    if (step * std::min(1., step / last) < exact) break;
    if (pass == most_passes || !std::isfinite(step)) return Status::failed("the sensitivities did not converge");
    if (step > too_slow * last && !own_factor) {
      own_factor = true;
      if (Status status = assembly_->assemble(*material_, state, load.pressure, true, system_); !status.ok())
        return status;
      if (!factorise()) return Status::failed("the time limit is reached");
      begin_adjoint(positions, axial_force);
      step = 1;
    }
    last = step;
  }
  weights.resize(count);
  defects_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const State& y = adjoint_[k];
    defects_[k] = dot(y.q, residual_.q) - dot(y.x, residual_.x);
    std::swap(weights[k].right, adjoint_[k].x);
    std::swap(weights[k].dilation, adjoint_[k].q);
    std::swap(weights[k].moved, moved_ends_[k]);
  }
  return {};
}

/// The part of the axial force that y has at prescribed positions.
void Solver::add_own(std::span<const std::size_t> positions, std::size_t k, std::span<double> x) const {
  for (std::size_t i = 0; i < (k == positions.size() ? mesh_.across() : 0); ++i)
    x[2 * mesh_.node(i, 0) + 1] += 2 * std::numbers::pi;
}

/// a; what the support stores depends on the outer radius.
void Solver::add_observable(std::span<const std::size_t> positions, std::size_t k, std::span<double> to) const {
  if (k < positions.size())
    to[positions[k]] += 1;
  else
    to[outer()] -= 2 * std::numbers::pi * middle_pressed_;
}

void Solver::solve_rights() {
  const std::vector<std::span<double>> together(rights_.begin(), rights_.end());
  for (const std::span<double> x : together) prescribe(x);
  factor_.solve(together);
  for (const std::span<double> x : together) prescribe(x);
}

/// As if the factor were the equations.
void Solver::begin_adjoint(std::span<const std::size_t> positions, bool axial_force) {
  const std::size_t count = positions.size() + (axial_force ? 1 : 0);
  rights_.resize(count);
  adjoint_.resize(count);
  multiplied_.resize(count);
  moved_ends_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    rights_[k].assign(dx_.size(), 0);
    add_observable(positions, k, rights_[k]);
    for (std::size_t i = 0; i < (k == positions.size() ? middle_.size() : 0); ++i)
      rights_[k][i] -= 2 * std::numbers::pi * middle_[i];
  }
  solve_rights();
  for (std::size_t k = 0; k < count; ++k) {
    adjoint_[k].x = rights_[k];
    add_own(positions, k, adjoint_[k].x);
    adjoint_[k].q.resize(dq_.size());
    assembly_->pressures(system_, adjoint_[k].x, {}, adjoint_[k].q);
  }
}

/// One pass; `step` is the largest of y over its largest entry.
Status Solver::refine_adjoint(const Load& load, const State& state, std::span<const std::size_t> positions,
                              Changes* changes, double& step) {
  const std::size_t end = 2 * mesh_.node(0, mesh_.planes() - 1);
  if (late()) return Status::failed("the time limit is reached");
  if (Status status = assembly_->multiply(*material_, state, load.pressure, adjoint_, multiplied_, residual_, changes);
      !status.ok())
    return status;
  for (std::size_t k = 0; k < adjoint_.size(); ++k) {
    std::vector<double>& right = rights_[k];
    assembly_->pressures(system_, {}, multiplied_[k].q, dq_);
    assembly_->spread(system_, dq_, right);
    add_observable(positions, k, right);
    for (std::size_t i = 0; i < right.size(); ++i) right[i] -= multiplied_[k].x[i];
    moved_ends_[k].assign(right.begin() + static_cast<std::ptrdiff_t>(end), right.end());
  }
  solve_rights();
  for (std::size_t k = 0; k < adjoint_.size(); ++k) {
    State& y = adjoint_[k];
    const double dy = largest(rights_[k]), of = dy == 0 ? 0 : dy / largest(y.x);
    if (std::isfinite(step) && !(of <= step)) step = of;  // what is no number stays
    for (std::size_t i = end; i < dx_.size(); ++i) moved_ends_[k][i - end] -= system_.matrix.row_times(i, rights_[k]);
    assembly_->pressures(system_, rights_[k], multiplied_[k].q, dq_);
    for (std::size_t i = 0; i < dx_.size(); ++i) y.x[i] += rights_[k][i];
    for (std::size_t i = 0; i < dq_.size(); ++i) y.q[i] += dq_[i];
  }
  return {};
}

}  // namespace tunica::fe
