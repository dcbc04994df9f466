// SPDX-License-Identifier: Apache-2.0
#include "pulling.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::plane {

Pulling::Pulling(const Body& body, const Model& model, std::span<const double> parameters, std::array<double, 2> along,
                 bool compressible)
    : body_(body),
      membrane_(model, parameters, along, compressible ? Faces::free : Faces::incompressible),
      u_(body.dofs(), 0.0),
      K_(body.pattern()),
      factor_(body, K_) {
  membrane_.resize(body.points());
}

bool Pulling::evaluate(bool with_tangent, bool with_parameters) {
  body_.strain(u_, F_, membrane_);
  for (const auto& F : F_)
    if (!(F[0] * F[3] - F[1] * F[2] > 0)) return false;
  if (!membrane_.evaluate(with_tangent, with_parameters)) return false;
  body_.forces(F_, membrane_.stress, f_);
  return std::all_of(f_.begin(), f_.end(), [](double x) { return std::isfinite(x); });
}

bool Pulling::factor() {
  body_.stiffness(F_, membrane_, K_, by_pull_);
  factored_ = factor_.factorise(K_);
  return factored_;
}

Eigen::MatrixXd Pulling::solve(const Factor& factor, std::span<const std::vector<double>> of_dofs) const {
  const auto& free = body_.free();
  Eigen::MatrixXd x(static_cast<Eigen::Index>(free.size()), static_cast<Eigen::Index>(of_dofs.size()));
  for (std::size_t j = 0; j < of_dofs.size(); ++j)
    for (std::size_t k = 0; k < free.size(); ++k)
      x(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) = -of_dofs[j][free[k]];
  factor.solve(x);
  return x;
}

/// K du = −f − (∂f/∂d) dd, and dd from the gauge where it is the driver. The factor of the state before makes the first
/// step; where steps are small, one factor serves several, as long as each is a fifth of the one before: a factor takes
/// the time of five steps.
bool Pulling::newton(double target, const Gauge* driver) {
  const std::vector<double>& grips = body_.grips();
  const auto& free = body_.free();
  bool reuse = factored_;
  double before = 1e300;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    factored_ = factored_ && reuse;
    if (!evaluate(!reuse, false) || (!reuse && !factor())) return false;
    if (!reuse) along_ = solve(factor_, {&by_pull_, 1});
    const Eigen::VectorXd rest = solve(factor_, {&f_, 1});
    double dpull = driver == nullptr ? target - pull_ : 0;
    if (driver != nullptr) dpull = (target - value(*driver) - reading(*driver, rest, 0)) / reading(*driver, along_, 1);
    const Eigen::VectorXd du = rest + dpull * along_;
    double largest = std::abs(dpull), size = 1e-3;
    if (du.size() > 0) largest = std::max(largest, du.lpNorm<Eigen::Infinity>());
    if (!std::isfinite(largest)) return false;
    for (std::size_t k = 0; k < free.size(); ++k) u_[free[k]] += du[static_cast<Eigen::Index>(k)];
    pull_ += dpull;
    for (std::size_t dof = 0; dof < u_.size(); ++dof)
      if (grips[dof] != 0) u_[dof] = pull_ * grips[dof];
    for (const double x : u_) size = std::max(size, std::abs(x));
    // A step with its own factor leaves its square behind, one with an older factor a share of itself.
    const double shrinks = largest / before;
    if (largest <= (reuse ? 1e-12 : 1e-8) * size ||
        (reuse && iteration > 0 && shrinks < 0.3 && largest * shrinks <= 1e-12 * size))
      return evaluate(false, false);
    if (iteration > 2 && largest > 2 * before) return false;
    reuse = reuse && iteration > 0 ? shrinks < 0.2 : largest < 0.02 * size;
    before = largest;
  }
  return false;
}

double Pulling::reading(const Gauge& gauge, const Eigen::VectorXd& du, double dpull) const {
  double sum = 0;
  for (const auto& [dof, weight] : gauge.reading) {
    const std::size_t unknown = body_.unknown(dof);
    sum += weight * (unknown == Body::none ? dpull * body_.grips()[dof] : du[static_cast<Eigen::Index>(unknown)]);
  }
  return sum;
}

std::optional<std::string> Pulling::move_to(double target, const Gauge* driver) {
  driver_ = driver;
  const double from = driver == nullptr ? pull_ : value(*driver);
  if (reached_.empty()) reached_.push_back({from, pull_, u_});
  double reached = 0, step = 1;
  for (int trial = 0; trial < 60 && step > smallest_step; ++trial) {
    const std::vector<double> u = u_, normal = membrane_.normal;
    const double pull = pull_;
    const double next = std::min(1.0, reached + step), at = from + next * (target - from);
    if (trial == 0) extrapolate(at);
    if (newton(at, driver)) {
      if (reached_.size() == most_states) reached_.erase(reached_.begin());
      reached_.push_back({at, pull_, u_});
      if (next >= 1) return {};
      reached = next;
      step *= 2;
    } else {
      u_ = u;
      pull_ = pull;
      membrane_.normal = normal;
      step /= 3;
      factored_ = false;
    }
  }
  return "no equilibrium was found on the way, since the material loses its stability or the mesh is distorted; narrow "
         "the "
         "bounds of the model's parameters";
}

/// The polynomial through the states behind, as far as they lie on the way and it does not go far beyond them:
///
///     u(t) = Σ_k u_k Π_{m≠k} (t − t_m)/(t_k − t_m)
void Pulling::extrapolate(double target) {
  std::size_t first = reached_.size() - 1;
  const double way = target - reached_.back().target;
  while (first > 0) {
    const double gap = reached_[first].target - reached_[first - 1].target;
    if (gap * way <= 0 || std::abs(way) > 2 * std::abs(gap)) break;
    --first;
  }
  if (first == reached_.size() - 1) return;
  std::fill(u_.begin(), u_.end(), 0.0);
  pull_ = 0;
  for (std::size_t k = first; k < reached_.size(); ++k) {
    double weight = 1;
    for (std::size_t m = first; m < reached_.size(); ++m)
      if (m != k) weight *= (target - reached_[m].target) / (reached_[k].target - reached_[m].target);
    for (std::size_t dof = 0; dof < u_.size(); ++dof) u_[dof] += weight * reached_[k].u[dof];
    pull_ += weight * reached_[k].pull;
  }
}

/// With a factor and a normal stretch of its own: whether derivatives are wanted must not change the rows that follow.
bool Pulling::linearise(bool by_parameters, const Gauge* driver) {
  driver_ = driver;
  const std::vector<double> normal = membrane_.normal;
  const bool evaluated = evaluate(true, by_parameters);
  membrane_.normal = normal;
  if (!evaluated) return false;
  body_.stiffness(F_, membrane_, K_, linear_.by_pull);
  if (!linear_.factor) linear_.factor.emplace(body_, K_);
  if (!linear_.factor->factorise(K_)) return false;
  linear_.along = solve(*linear_.factor, {&linear_.by_pull, 1});
  linear_.slope = 1;
  if (driver != nullptr) linear_.slope = 1 / reading(*driver, linear_.along, 1);
  const std::size_t n = 3 * body_.points();
  linear_.by_parameters.resize(by_parameters ? membrane_.stress_dp.size() / n : 0);
  for (std::size_t j = 0; j < linear_.by_parameters.size(); ++j)
    body_.forces(F_, std::span(membrane_.stress_dp).subspan(j * n, n), linear_.by_parameters[j]);
  linear_.du = solve(*linear_.factor, linear_.by_parameters);
  return linear_.along.allFinite() && linear_.du.allFinite();
}

double Pulling::grip_force(const std::vector<double>& f) const {
  double force = 0;
  for (std::size_t dof = 0; dof < f.size(); ++dof) force += body_.grips()[dof] * f[dof];
  // Both grips count half; of a quarter, one half of one grip is there.
  return body_.mesh().quarter ? 4 * force : force;
}

double Pulling::value(const Gauge& gauge) const {
  if (gauge.kind == Gauge::Kind::stress) return f_.empty() ? 0 : grip_force(f_) / gauge.area;
  double stretch = 1;
  for (const auto& [dof, weight] : gauge.reading) stretch += weight * u_[dof];
  return stretch;
}

double Pulling::change(const Gauge& gauge, const Eigen::VectorXd& du, double dpull,
                       const std::vector<double>& df) const {
  if (gauge.kind != Gauge::Kind::stress) return reading(gauge, du, dpull);
  // Work of the grips: d(gripsᵀ f) = gripsᵀ df + gripsᵀ ∂f/∂u du, and ∂f/∂u is symmetric.
  const auto& free = body_.free();
  const double sum = grip_force(df);
  double by_u = 0;
  for (std::size_t k = 0; k < free.size(); ++k) by_u += linear_.by_pull[free[k]] * du[static_cast<Eigen::Index>(k)];
  return (sum + (body_.mesh().quarter ? 4 : 1) * by_u) / gauge.area;
}

double Pulling::by_target(const Gauge& gauge) const {
  std::vector<double> df = linear_.by_pull;
  for (double& x : df) x *= linear_.slope;
  return change(gauge, linear_.slope * linear_.along, linear_.slope, df);
}

double Pulling::by_parameter(const Gauge& gauge, std::size_t j) const {
  std::vector<double> df = linear_.by_parameters[j];
  Eigen::VectorXd du = linear_.du.col(static_cast<Eigen::Index>(j));
  double dpull = 0;
  if (driver_ != nullptr) {
    dpull = -change(*driver_, du, 0, df) * linear_.slope;
    du += dpull * linear_.along;
  }
  for (std::size_t dof = 0; dof < df.size(); ++dof) df[dof] += dpull * linear_.by_pull[dof];
  return change(gauge, du, dpull, df);
}

}  // namespace tunica::plane
