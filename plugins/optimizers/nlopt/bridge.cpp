// SPDX-License-Identifier: Apache-2.0
#include "bridge.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/optimizers/augmented_lagrangian.hpp"

namespace tunica::nlopt_plugin {
namespace {

/// ∇f = Σ 2 w ρ'(‖r‖²) Jᵀr over the blocks, ρ' = 1 or 1/(2√(s + ε²)).
void gradient_of(const Problem& problem, std::span<const double> residuals, std::span<const double> jacobian,
                 std::span<double> gradient) {
  const std::size_t n = gradient.size();
  std::ranges::fill(gradient, 0.0);
  for (const ResidualBlock& block : problem.blocks()) {
    double s = 0;
    for (std::size_t i = 0; i < block.size; ++i) s += residuals[block.offset + i] * residuals[block.offset + i];
    const bool root = block.loss == ResidualBlock::Loss::root;
    constexpr double e = Problem::root_smoothing;
    const double factor = 2 * block.weight * (root ? 0.5 / std::sqrt(s + e * e) : 1);
    for (std::size_t i = block.offset; i < block.offset + block.size; ++i) {
      for (std::size_t j = 0; j < n; ++j) gradient[j] += factor * residuals[i] * jacobian[i * n + j];
    }
  }
}

}  // namespace

Bridge::Bridge(Problem& problem, Rules rules) : problem_(problem), rules_(rules), x_(problem.dimension()) {
  if (!rules_.gradient) return;
  residuals_.resize(problem.residual_count());
  jacobian_.resize(residuals_.size() * x_.size());
  gradient_.resize(x_.size());
}

void Bridge::attach(nlopt::opt& opt, bool constraints) {
  opt_ = &opt;
  opt.set_lower_bounds(0.0);
  opt.set_upper_bounds(1.0);
  opt.set_min_objective(&Bridge::objective, this);
  if (const std::size_t m = problem_.constraint_count(); constraints && m > 0) {
    opt.add_inequality_mconstraint(&Bridge::constraints, this, std::vector<double>(m, 0.0));
  }
}

double Bridge::objective(unsigned /*n*/, const double* x, double* gradient, void* self) {
  Bridge& bridge = *static_cast<Bridge*>(self);
  try {
    return bridge.value_at(x, gradient);
  } catch (...) {
    bridge.thrown_ = std::current_exception();
    bridge.opt_->force_stop();
    return HUGE_VAL;
  }
}

void Bridge::constraints(unsigned m, double* values, unsigned /*n*/, const double* x, double* jacobian, void* self) {
  Bridge& bridge = *static_cast<Bridge*>(self);
  try {
    bridge.constraints_at(x, values, jacobian);
  } catch (...) {
    bridge.thrown_ = std::current_exception();
    bridge.opt_->force_stop();
    std::fill_n(values, m, 1.0);
  }
}

/// NLopt may leave its bounds by rounding.
void Bridge::move_to(const double* x) {
  for (std::size_t j = 0; j < x_.size(); ++j) {
    if (std::isnan(x[j])) return halt(Stop::not_a_number);
    const double inside = std::clamp(x[j], 0.0, 1.0);
    if (inside != x_[j]) known_ = false;
    x_[j] = inside;
  }
}

/// SLSQP asks for the value of a trial point first and for its gradient once it is accepted: one evaluation.
double Bridge::value_at(const double* x, double* gradient) {
  move_to(x);
  if (stop_ == Stop::none && !known_) {
    if (problem_.should_stop()) {
      halt(Stop::problem);
    } else {
      const Status status = evaluate(x_);
      value_ = value_of(x_, status, value_);
      known_ = rules_.gradient;
    }
  }
  if (stop_ != Stop::none) value_ = worst_;
  if (!rules_.gradient) return value_;
  // SLSQP begins with the Hessian 1: a slope of a million bounds would end its line search at once.
  if (scale_ == 0) {
    scale_ = 1;
    for (const double slope : gradient_)
      if (std::isfinite(slope)) scale_ = std::max(scale_, std::abs(slope));
  }
  if (gradient != nullptr) std::ranges::transform(gradient_, gradient, [this](double slope) { return slope / scale_; });
  return value_ / scale_;
}

Status Bridge::evaluate(std::span<const double> x) {
  ++evaluated_;
  if (!rules_.gradient) return problem_.evaluate(x, value_);
  Status status = problem_.linearise(x, value_, residuals_, jacobian_);
  if (status.kind() != Status::Kind::failed) {
    gradient_of(problem_, residuals_, jacobian_, gradient_);
  } else {
    std::ranges::fill(gradient_, 0.0);
  }
  return status;
}

double Bridge::value_of(std::span<const double> x, const Status& status, double objective) {
  if (status.kind() == Status::Kind::failed) return value_of_failure(status);
  const double violation = status.violation();
  if (Point here{{}, objective, violation}; here.better_than(best_)) {
    here.x.assign(x.begin(), x.end());
    best_ = std::move(here);
  }
  note_progress();
  double value = objective;
  if (rules_.infeasible == Infeasible::ranked) value = violation > 0 ? violation : -1 / (objective + 1e-300);
  worst_ = std::max(worst_, value);
  return value;
}

double Bridge::value_of_failure(const Status& status) {
  if (failure_.empty()) failure_ = status.reason();
  if (best_.x.empty() && evaluated_ >= gives_up_after) halt(Stop::nothing_succeeded);
  if (!best_.x.empty()) note_progress();
  if (rules_.failed == Failed::infinite) return HUGE_VAL;
  if (rules_.failed == Failed::worst || best_.x.empty()) return worst_;
  if (rules_.failed == Failed::nearer) {
    constexpr int halvings = 5;
    nearer_ = x_;
    for (int k = 0; k < halvings && !problem_.should_stop(); ++k) {
      for (std::size_t j = 0; j < nearer_.size(); ++j) nearer_[j] = 0.5 * (nearer_[j] + best_.x[j]);
      const Status status_there = evaluate(nearer_);
      if (status_there.kind() != Status::Kind::failed) return value_of(nearer_, status_there, value_);
    }
  }
  return worst_ + std::abs(worst_) + 1;
}

/// Progress is measured from the last significant improvement, so a slow descent adds up.
void Bridge::note_progress() {
  const double enough = rules_.tolerance * std::abs(progress_from_);
  const bool nearer = best_.violation < violation_from_ * (1 - rules_.tolerance);
  const bool lower = best_.violation == violation_from_ && best_.objective < progress_from_ - enough;
  if (nearer || lower || violation_from_ == std::numeric_limits<double>::infinity()) {
    violation_from_ = best_.violation;
    progress_from_ = best_.objective;
    progress_at_ = evaluated_;
  } else if (rules_.stall > 0 && evaluated_ - progress_at_ >= rules_.stall) {
    halt(Stop::stalled);
  }
}

/// Tightened by half the tolerance, so a converged search ends at a feasible point.
void Bridge::constraints_at(const double* x, double* values, double* jacobian) {
  move_to(x);
  const std::size_t m = problem_.constraint_count();
  const Status status =
      stop_ == Stop::not_a_number
          ? Status::failed("not a number")
          : problem_.constraints(x_, {values, m}, {jacobian, jacobian == nullptr ? 0 : m * x_.size()});
  if (status.kind() == Status::Kind::failed) {
    std::fill_n(values, m, 1.0);
    if (jacobian != nullptr) std::fill_n(jacobian, m * x_.size(), 0.0);
    return;
  }
  for (std::size_t i = 0; i < m; ++i) values[i] += AugmentedLagrangian::margin;
}

void Bridge::halt(Stop reason) {
  if (stop_ == Stop::none) stop_ = reason;
  opt_->force_stop();
}

}  // namespace tunica::nlopt_plugin
