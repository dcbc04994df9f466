// SPDX-License-Identifier: Apache-2.0
#include "equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tunica::field {

Equilibrium::Equilibrium(const Specimen& specimen, const Model& model, std::span<const double> parameters,
                         std::array<double, 2> along, plane::Faces faces, std::vector<double> weights)
    : specimen_(specimen),
      membrane_(model, parameters, along, faces),
      weights_(std::move(weights)),
      u_(specimen.dofs(), 0.0),
      K_(specimen.pattern()) {
  membrane_.resize(specimen.elements().points());
}

bool Equilibrium::evaluate(bool with_tangent, bool with_parameters) {
  specimen_.elements().strain(u_, F_, membrane_);
  for (const auto& F : F_)
    if (!(F[0] * F[3] - F[1] * F[2] > 0)) return false;
  if (!membrane_.evaluate(with_tangent, with_parameters)) return false;
  weigh(membrane_.stress);
  if (with_tangent) weigh(membrane_.tangent);
  if (with_parameters) weigh(membrane_.stress_dp);
  f_.assign(specimen_.dofs(), 0);
  specimen_.elements().add_forces(F_, membrane_.stress, f_);
  return std::all_of(f_.begin(), f_.end(), [](double x) { return std::isfinite(x); });
}

/// Values of one Gauss point after another, any number of times.
void Equilibrium::weigh(std::vector<double>& of_points) const {
  for (std::size_t i = 0; i < of_points.size() && !weights_.empty(); ++i) of_points[i] *= weights_[i % weights_.size()];
}

bool Equilibrium::factor(const std::vector<double>& direction) {
  specimen_.elements().stiffness(F_, membrane_, direction, K_, by_direction_);
  if (!analysed_) factor_.analyzePattern(K_);
  analysed_ = true;
  factor_.factorize(K_);
  return factor_.info() == Eigen::Success;
}

Eigen::VectorXd Equilibrium::solve(const std::vector<double>& of_dofs) const {
  const auto& free = specimen_.free();
  Eigen::VectorXd right(static_cast<Eigen::Index>(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k) right[static_cast<Eigen::Index>(k)] = of_dofs[free[k]];
  return factor_.solve(right);
}

/// K du = −f − ∂f/∂u_held direction. The first step moves the held displacements, the others leave them. Where steps
/// are small, one factor serves several, as long as each is a tenth of the one before.
bool Equilibrium::newton(std::vector<double> direction) {
  bool reuse = false, evaluated = false;
  double before = 1e300, size = 0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    if (!evaluated && !evaluate(!reuse, false)) return false;
    if (!reuse && !factor(direction)) return false;
    std::vector<double> right = f_;
    if (iteration == 0)
      for (std::size_t dof = 0; dof < right.size(); ++dof) right[dof] += by_direction_[dof];
    const Eigen::VectorXd du = -solve(right);
    const double largest = du.size() > 0 ? du.lpNorm<Eigen::Infinity>() : 0;
    if (!std::isfinite(largest)) return false;
    size = 1e-6 * std::max(specimen_.extent(0), specimen_.extent(1));
    for (const double x : u_) size = std::max(size, std::abs(x));
    const bool shrinks = largest < 0.3 * before;
    evaluated = iteration > 0 && !reuse && (largest >= small_step * size || (iteration > 1 && !shrinks));
    if (evaluated) {
      if (!search_along(du)) return false;
    } else {
      add_free(du, u_);
    }
    if (iteration == 0) {
      for (std::size_t dof = 0; dof < u_.size(); ++dof) u_[dof] += direction[dof];
      std::fill(direction.begin(), direction.end(), 0.0);
    }
    // A step with its own factor leaves its square behind, one with an older factor a share of itself.
    if (iteration > 0 && largest <= (reuse ? 1e-11 : 1e-7) * size) return evaluate(false, false);
    reuse =
        iteration > 0 && (reuse ? largest < 0.1 * before : largest < small_step * size && (iteration == 1 || shrinks));
    before = largest;
  }
  return false;
}

/// Moves by s du with the largest tried s ≤ 1 whose slope duᵀf is not above half of what it was before, with the other
/// sign (Crisfield, Non-linear Finite Element Analysis of Solids and Structures, vol. 1, 1991, § 9.2). Where fibres are
/// switched on, the whole step stretches them by what the matrix alone would bear.
bool Equilibrium::search_along(const Eigen::VectorXd& du) {
  constexpr int cuts = 12;
  const auto slope = [&] {
    double sum = 0;
    for (std::size_t k = 0; k < specimen_.free().size(); ++k)
      sum += du[static_cast<Eigen::Index>(k)] * f_[specimen_.free()[k]];
    return sum;
  };
  const double first = slope();
  const std::vector<double> normal = membrane_.normal;
  double moved = 0, next = 1;
  for (int cut = 0; cut < cuts; ++cut) {
    add_free((next - moved) * du, u_);
    moved = next;
    const bool usable = evaluate(true, false);
    const double now = usable ? slope() : 0;
    if (usable && (first >= 0 || now <= -0.5 * first)) return true;
    next *= usable ? std::clamp(first / (first - now), 0.1, 0.5) : 0.3;
    if (!usable) membrane_.normal = normal;
  }
  return false;
}

std::optional<std::string> Equilibrium::move_to(const std::vector<double>& prescribed) {
  double left = 1, step = 1;
  for (int trial = 0; trial < 60 && step > smallest_step; ++trial) {
    const std::vector<double> u = u_, normal = membrane_.normal;
    const double share = std::min(1.0, step / left);
    std::vector<double> direction(u_.size(), 0.0);
    for (std::size_t dof = 0; dof < u_.size(); ++dof)
      if (specimen_.held(dof)) direction[dof] = share * (prescribed[dof] - u_[dof]);
    if (newton(std::move(direction))) {
      if (share >= 1) return {};
      left -= step;
      step *= 2;
    } else {
      u_ = u;
      membrane_.normal = normal;
      step = std::min(step, left) / 3;
    }
  }
  return "no equilibrium was found on the way, since the material loses its stability or the mesh is distorted; narrow "
         "the bounds of the model's parameters";
}

void Equilibrium::begin(State state) {
  u_ = std::move(state.u);
  state.normal.resize(membrane_.normal.size(), 1.0);
  membrane_.normal = std::move(state.normal);
}

bool Equilibrium::move_by(const std::vector<double>& change) {
  for (std::size_t dof = 0; dof < u_.size(); ++dof) u_[dof] += change[dof];
  return evaluate(false, false);
}

void Equilibrium::return_to_linearised() {
  F_ = linearised_F_;
  membrane_.stress = linearised_stress_;
}

std::vector<double> Equilibrium::newton_step() const {
  std::vector<double> du(u_.size(), 0.0);
  add_free(-solve(f_), du);
  return du;
}

void Equilibrium::add_force_change(const std::vector<double>& du, std::vector<double>& df) const {
  specimen_.elements().add_force_change(F_, membrane_, du, df);
}

bool Equilibrium::linearise(bool by_parameters) {
  const std::vector<double> normal = membrane_.normal;
  const bool evaluated = evaluate(true, by_parameters);
  membrane_.normal = normal;
  linearised_F_ = F_;
  linearised_stress_ = membrane_.stress;
  return evaluated && factor(std::vector<double>(u_.size(), 0.0));
}

void Equilibrium::add_free(const Eigen::VectorXd& change, std::vector<double>& u) const {
  const auto& free = specimen_.free();
  for (std::size_t k = 0; k < free.size(); ++k) u[free[k]] += change[static_cast<Eigen::Index>(k)];
}

void Equilibrium::by_parameter(std::size_t j, std::vector<double>& du, std::vector<double>& df) const {
  const std::size_t n = 3 * specimen_.elements().points();
  by_stress(std::span(membrane_.stress_dp).subspan(j * n, n), du, df);
}

void Equilibrium::by_weight(std::span<const double> change, std::vector<double>& du, std::vector<double>& df) const {
  std::vector<double> stress = membrane_.stress;
  for (std::size_t i = 0; i < stress.size(); ++i) {
    const std::size_t point = i % change.size();
    stress[i] *= change[point] / (weights_.empty() ? 1.0 : weights_[point]);
  }
  by_stress(stress, du, df);
}

void Equilibrium::by_stress(std::span<const double> change, std::vector<double>& du, std::vector<double>& df) const {
  df.assign(u_.size(), 0);
  specimen_.elements().add_forces(F_, change, df);
  du.assign(u_.size(), 0);
  add_free(-solve(df), du);
  specimen_.elements().add_force_change(F_, membrane_, du, df);
}

void Equilibrium::by_edge(const Mode& mode, std::vector<double>& du, std::vector<double>& df) const {
  du.assign(u_.size(), 0);
  for (const auto& [dof, value] : mode) du[dof] += value;
  df.assign(u_.size(), 0);
  specimen_.elements().add_force_change(F_, membrane_, du, df);
  add_free(-solve(df), du);
  df.assign(u_.size(), 0);
  specimen_.elements().add_force_change(F_, membrane_, du, df);
}

}  // namespace tunica::field
