// SPDX-License-Identifier: Apache-2.0
#include "solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

namespace tunica::fe {
namespace {

constexpr std::size_t most_iterations = 14;
constexpr double frozen_below = 1e-3;      ///< of the outer radius: the last factor serves for steps shorter than this
constexpr double slow = 0.3;               ///< a step of a frozen factor this times the last one is too long
constexpr double near = 2e-5;              ///< a factor of a state this near to the solution is nearly its own
constexpr double contraction = 0.15;       ///< of a step by the last load's factor, as it mostly is
constexpr double good_for_weights = 1e-9;  ///< what may be left of the state, over the outer radius
constexpr double incompressibility = 5e5;  ///< γ over the largest modulus: see System; 1e5 to 1e7 behave alike

}  // namespace

Solver::Solver(const Mesh& mesh) : mesh_(mesh), assembly_(Assembly::make(mesh)), factor_(mesh) {
  rest_.x.resize(2 * mesh_.nodes());
  for (std::size_t k = 0; k < mesh_.planes(); ++k)
    for (std::size_t i = 0; i < mesh_.across(); ++i) {
      rest_.x[2 * mesh_.node(i, k)] = mesh_.radius(i);
      rest_.x[2 * mesh_.node(i, k) + 1] = mesh_.layer[k];
    }
  rest_.q.assign(assembly_->pressure_count(), 0);
  assembly_->late = [this] { return late(); };
  end_moved_.assign(rest_.x.size(), 0);
  for (std::size_t i = 0; i < mesh_.across(); ++i)
    end_moved_[2 * mesh_.node(i, mesh_.planes() - 1) + 1] = mesh_.half_length();
  dx_.resize(rest_.x.size());
  dq_.resize(rest_.q.size());
  product_.resize(rest_.x.size());
}

/// Of each weight of an observable State::x stands in four vectors and State::q in three.
double Solver::bytes(const Mesh& mesh) {
  const auto positions = static_cast<double>(2 * mesh.nodes());
  const auto pressures = static_cast<double>((mesh.order == 1 ? 1 : 3) * mesh.radial * mesh.axial);
  const auto weights = static_cast<double>(together(mesh));
  return Factor::bytes(mesh) + Stencil::bytes(mesh) + 8 * weights * (4 * positions + 3 * pressures);
}

/// As many as take 30 MB in each of those vectors.
std::size_t Solver::together(const Mesh& mesh) {
  return std::clamp<std::size_t>(4'000'000 / (2 * mesh.nodes()), 4, 32);
}

Status Solver::begin(const Material& material) {
  material_ = &material;
  held_ = mesh_.ends == Ends::clamped;
  hold_at(rest_);
  // At rest S = 2 ∂W/∂C − q C⁻¹ has to vanish: q is 2 ∂W/∂C_rr there, all three being equal up to a pressure.
  const std::size_t lanes = mesh_.radial;
  std::vector<double> unit(4 * lanes, 1), first(Material::firsts * lanes);
  std::fill_n(unit.begin() + static_cast<std::ptrdiff_t>(3 * lanes), lanes, 0.0);
  if (Status status = material.evaluate(lanes, unit, first, {}, {}); !status.ok()) return status;
  const std::size_t modes = rest_.q.size() / (mesh_.radial * mesh_.axial);
  for (std::size_t i = 0; i < rest_.q.size(); ++i)
    rest_.q[i] = i % modes == 0 ? 2 * first[2 * lanes + i / modes % lanes] : 0;
  system_.gamma = 1;
  if (Status status = assembly_->assemble(material, rest_, 0, true, system_); !status.ok()) return status;
  system_.gamma = incompressibility * system_.stiffness;
  effort_ = {};
  has_factor_ = false;
  return {};
}

void Solver::hold_at(const State& state) {
  held_radius_.clear();
  for (std::size_t i = 0; i < mesh_.across(); ++i)
    held_radius_.push_back(state.x[2 * mesh_.node(i, mesh_.planes() - 1)]);
}

void Solver::impose(const Load& load, State& state) const {
  const std::size_t end = mesh_.planes() - 1;
  for (std::size_t i = 0; i < mesh_.across(); ++i) {
    state.x[2 * mesh_.node(i, 0) + 1] = 0;
    state.x[2 * mesh_.node(i, end) + 1] = load.stretch * mesh_.half_length();
    if (held_) state.x[2 * mesh_.node(i, end)] = held_radius_[i];
  }
}

void Solver::prescribe(std::span<double> dx) const {
  const std::size_t end = mesh_.planes() - 1;
  for (std::size_t i = 0; i < mesh_.across(); ++i) {
    dx[2 * mesh_.node(i, 0) + 1] = dx[2 * mesh_.node(i, end) + 1] = 0;
    if (held_) dx[2 * mesh_.node(i, end)] = 0;
  }
}

bool Solver::factorise() {
  middle_.assign(2 * (mesh_.order + 1) * mesh_.across(), 0);  // the planes that share an element with the first
  for (std::size_t i = 0; i < mesh_.across(); ++i) {
    const std::size_t row = 2 * mesh_.node(i, 0) + 1;
    for (std::size_t j = 0; j < middle_.size(); ++j)
      middle_[j] += system_.matrix.entry(std::max(row, j), std::min(row, j));
  }
  const std::size_t end = mesh_.planes() - 1;
  fixed_.clear();
  for (std::size_t i = 0; i < mesh_.across(); ++i) {
    fixed_.push_back(2 * mesh_.node(i, 0) + 1);
    fixed_.push_back(2 * mesh_.node(i, end) + 1);
    if (held_) fixed_.push_back(2 * mesh_.node(i, end));
  }
  const double diagonal = *system_.matrix.column(2 * mesh_.node(mesh_.across() / 2, end / 2));
  const auto negative = factor_.factorise(system_.matrix, fixed_, diagonal, [this] { return late(); });
  has_factor_ = negative.has_value();
  negative_ = negative.value_or(0);
  ++effort_.factorisations;
  return has_factor_;
}

Status Solver::solve(const Load& load, State& state, Aim aim) {
  const double gamma = system_.gamma;
  Status status = iterate(load, state, aim);
  if (status.ok()) note_support(state);
  if (!status.ok()) {  // what a wild state left behind
    system_.gamma = gamma;
    has_factor_ = false;
  }
  return status;
}

Status Solver::iterate(const Load& load, State& state, Aim aim) {
  const bool wants_factor = aim != Aim::state;
  impose(load, state);
  effort_.steps.clear();
  mixes_ = false;
  double last = std::numeric_limits<double>::infinity();
  double away = last;  // how far the state of the factor is
  // Near the last solution its factor comes close before a new one is made beside this one.
  bool full = !(wants_factor && has_factor_);
  const bool anew = full && wants_factor;
  for (std::size_t iteration = 0; iteration < most_iterations; ++iteration) {
    if (late()) return Status::failed("the time limit is reached");
    if (Status status = assembly_->assemble(*material_, state, load.pressure, full, system_); !status.ok())
      return status;
    if (full && !factorise()) return Status::failed("the time limit is reached");
    ++effort_.iterations;
    std::copy(system_.right.begin(), system_.right.end(), dx_.begin());
    prescribe(dx_);
    factor_.solve(dx_);
    prescribe(dx_);
    const double step = largest(dx_) / mesh_.outer;
    effort_.steps.push_back(step);
    if (!std::isfinite(step)) return Status::failed("the stiffness is singular");
    if (step > 10) return Status::failed("Newton's method runs away");
    const double allowed = wants_factor ? 0.4 : slow;
    if (!full && step > allowed * last) {  // the factor is too old
      full = true;
      effort_.steps.pop_back();  // not taken
      system_.gamma = incompressibility * system_.stiffness;
      continue;
    }
    assembly_->pressures(system_, dx_, system_.dilation, dq_);
    note_force();
    move(state, !full);
    // A full step leaves an error of the order of its square, a frozen one that times its contraction.
    double left = full ? step * step * 10 : step * std::min(1., 2 * step / last);
    // The matrix of a material that remembers is not quite its tangent: see Material.
    if (full && material_->remembers())
      left = std::max(left, iteration == 0 ? step : step * std::min(1., 2 * step / last));
    away = full ? step : away + step;
    if (left < (aim == Aim::weights ? good_for_weights : tolerance) && (!wants_factor || away < near)) return {};
    if (iteration > 4 && step > 4 * last) return Status::failed("Newton's method diverges");
    const double next = aim == Aim::state ? 0 : aim == Aim::factor ? step : iteration > 0 ? left : contraction * step;
    const bool nearly = next < (aim == Aim::weights ? 0.5 * near : near);
    last = step;
    full = step > frozen_below || anew || (wants_factor && nearly && away >= near);
    if (full) system_.gamma = incompressibility * system_.stiffness;
  }
  return Status::failed(fmt::format("Newton's method did not converge in {} iterations", most_iterations));
}

/// Steps of a frozen factor shrink by a nearly constant matrix. What the last two say of it goes into this one, by
/// Anderson's mixing of depth 1: with steps s, s₋ and the movement m₋ that s₋ led to, m = s − β (m₋ + s − s₋), where β
/// makes s − β (s − s₋) smallest.
/// Source: D. G. M. Anderson, J. ACM 12 (1965) 547–560; H. F. Walker, P. Ni, SIAM J. Numer. Anal. 49 (2011) 1715–1735.
void Solver::move(State& state, bool mixed) {
  double along = 0, squared = 0;
  if (mixed && mixes_)
    for (std::size_t i = 0; i < dx_.size(); ++i) {
      const double change = dx_[i] - step_.x[i];
      along += dx_[i] * change;
      squared += change * change;
    }
  const double beta = squared > 0 ? along / squared : 0;
  const auto apply = [&](std::vector<double>& x, const std::vector<double>& step, std::vector<double>& last,
                         std::vector<double>& moved) {
    last.resize(step.size());
    moved.resize(step.size());
    for (std::size_t i = 0; i < step.size(); ++i) {
      moved[i] = beta == 0 ? step[i] : step[i] - beta * (moved[i] + step[i] - last[i]);
      last[i] = step[i];
      x[i] += moved[i];
    }
  };
  apply(state.x, dx_, step_.x, moved_.x);
  apply(state.q, dq_, step_.q, moved_.q);
  mixes_ = mixed;
}

/// V is of third order in r and z: x · ∂V/∂x = 3 V.
double Solver::volume(const State& state) const {
  return std::inner_product(state.x.begin(), state.x.end(), system_.volume.begin(), 0.0) / 3;
}

Status Solver::solve_volume(double volume, Load& load, State& state) {
  const double gamma = system_.gamma;
  Status status = iterate_volume(volume, load, state);
  if (status.ok()) note_support(state);
  if (!status.ok()) {
    system_.gamma = gamma;
    has_factor_ = false;
  }
  return status;
}

/// With v = ∂V/∂x, a = K̂⁻¹ right and b = K̂⁻¹ v the step is a + dP b, where V + v · (a + dP b) is the volume asked for.
Status Solver::iterate_volume(double volume, Load& load, State& state) {
  impose(load, state);
  effort_.steps.clear();
  mixes_ = false;
  double last = std::numeric_limits<double>::infinity();
  std::vector<double> b(dx_.size());
  for (std::size_t iteration = 0; iteration < most_iterations; ++iteration) {
    if (late()) return Status::failed("the time limit is reached");
    if (Status status = assembly_->assemble(*material_, state, load.pressure, true, system_); !status.ok())
      return status;
    if (!factorise()) return Status::failed("the time limit is reached");
    ++effort_.iterations;
    dx_ = system_.right;
    b = system_.volume;
    for (std::vector<double>* x : {&dx_, &b}) prescribe(*x), factor_.solve(*x), prescribe(*x);
    const double by_a = std::inner_product(dx_.begin(), dx_.end(), system_.volume.begin(), 0.0);
    const double by_b = std::inner_product(b.begin(), b.end(), system_.volume.begin(), 0.0);
    const double rise = (volume - this->volume(state) - by_a) / by_b;
    for (std::size_t i = 0; i < dx_.size(); ++i) dx_[i] += rise * b[i];
    const double step = largest(dx_) / mesh_.outer;
    effort_.steps.push_back(step);
    if (!std::isfinite(step)) return Status::failed("the stiffness is singular");
    if (step > 10 || (iteration > 4 && step > 4 * last)) return Status::failed("Newton's method diverges");
    assembly_->pressures(system_, dx_, system_.dilation, dq_);
    move(state, false);
    load.pressure += rise;
    system_.gamma = incompressibility * system_.stiffness;
    if (step * step * 10 < tolerance) return {};
    last = step;
  }
  return Status::failed(fmt::format("Newton's method did not converge in {} iterations", most_iterations));
}

void Solver::derive(std::span<const double> right, std::span<const double> moved, State& derivative) {
  derivative.x.resize(dx_.size());
  derivative.q.resize(dq_.size());
  if (moved.empty()) {
    std::copy(right.begin(), right.end(), derivative.x.begin());
  } else {
    system_.matrix.multiply(moved, product_);
    for (std::size_t i = 0; i < product_.size(); ++i) derivative.x[i] = (right.empty() ? 0 : right[i]) - product_[i];
  }
  prescribe(derivative.x);
  factor_.solve(derivative.x);
  prescribe(derivative.x);
  for (std::size_t i = 0; i < moved.size(); ++i) derivative.x[i] += moved[i];
  assembly_->pressures(system_, derivative.x, {}, derivative.q);
}

/// To first order after a step: ∂Π/∂x + K dx − G dq = −right + (K + γ G M⁻¹ Gᵀ) dx.
void Solver::note_force() {
  middle_force_ = 0;
  for (std::size_t j = 0; j < middle_.size(); ++j) middle_force_ += middle_[j] * dx_[j];
  for (std::size_t i = 0; i < mesh_.across(); ++i) middle_force_ -= system_.right[2 * mesh_.node(i, 0) + 1];
}

void Solver::note_support(const State& state) {
  const Support& support = assembly_->support;
  middle_support_ = middle_pressed_ = 0;
  if (support.slope == 0) return;
  middle_support_ = support.slope * Support::stored(outer_radius(state), support.free.front());
  middle_pressed_ = support.slope * Support::pressed(outer_radius(state), support.free.front());
}

}  // namespace tunica::fe
