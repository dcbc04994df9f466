// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tunica/optimizer.hpp"

namespace tunica {

/// A constrained problem as an unconstrained one, for optimizers that handle bounds alone:
///
///     L(x) = f(x) + (ρ/2) Σ max(0, c_i(x) + λ_i/ρ)²,
///
/// the augmented Lagrangian of Powell, Hestenes and Rockafellar without its constant. The penalty is one more residual
/// block, √(ρ/2) max(0, c + λ/ρ), so that least-squares methods see it and its Jacobian.
///
/// Use: minimise L from point(), call update(), and repeat while it returns Progress::going_on. Constraints are
/// tightened by half of Problem::constraint_tolerance, so that the end is feasible and not on the edge. The first
/// evaluation sets ρ, so that penalty and objective are comparable.
///
/// Where no constraint is active at the optimum, the objective alone leads there, past points that are not feasible:
/// First::objective_alone tries that before the first update(). From 100 random starts on the strips of the lamb aorta,
/// a descent of gho, whose optimum is stable, takes 78 evaluations instead of 144. One of hgo, whose optimum is not,
/// takes 134 instead of 135 for h = 1 and 128 instead of 117 for h = 0.7.
///
/// Status: every point that can be evaluated is `ok` here, feasible or not; best() knows the difference. Threads: not
/// thread-safe, as every Problem. Cost: one constraints() an evaluation. Ownership: the problem must outlive it.
///
/// Source: E. G. Birgin, J. M. Martínez, Practical Augmented Lagrangian Methods for Constrained Optimization, SIAM
/// (2014), algorithm 4.1 and section 12.4; J. Nocedal, S. J. Wright, Numerical Optimization (2006), chapter 17.
class AugmentedLagrangian : public Problem {
 public:
  /// What an evaluation really was.
  struct Point {
    std::vector<double> x;                                       ///< empty: none yet
    double objective = 0;                                        ///< f
    double violation = std::numeric_limits<double>::infinity();  ///< Status::violation()
  };
  /// What update() has found.
  enum class Progress {
    converged,   ///< feasible, and every multiplier belongs to an active constraint
    going_on,    ///< minimise again
    infeasible,  ///< the penalty has grown to its limit and some constraint is still broken
    nothing      ///< no point could be evaluated since the last update
  };
  /// What is minimised before the first update().
  enum class First { penalised, objective_alone };
  static constexpr double margin = 0.5 * constraint_tolerance;  ///< by which constraints are tightened

  /// Nothing is evaluated yet; all multipliers are 0.
  explicit AugmentedLagrangian(Problem& problem, First first = First::penalised)
      : problem_(problem),
        first_(first),
        blocks_(problem.blocks().begin(), problem.blocks().end()),
        n_(problem.dimension()),
        m_(problem.residual_count()),
        c_(problem.constraint_count()),
        c_jacobian_(c_.size() * n_),
        multipliers_(c_.size(), 0.0) {
    blocks_.push_back({m_, c_.size(), 1, ResidualBlock::Loss::quadratic});
  }

  /// The lowest point of L since the last update, or that of before while there is none: where to go on from.
  [[nodiscard]] const Point& point() const { return point_; }
  /// Best point so far: feasible ones by objective, before infeasible ones by violation.
  [[nodiscard]] const Point& best() const { return best_; }
  [[nodiscard]] double penalty() const { return penalty_; }  ///< ρ; 0 before the first evaluation
  [[nodiscard]] std::span<const double> multipliers() const { return multipliers_; }  ///< λ, one a constraint

  /// λ ← max(0, λ + ρ c) at the lowest point; ρ ← 10 ρ where infeasibility and complementarity, max |max(c, −λ/ρ)|,
  /// have not come down to the half. After the first minimisation ρ is set anew: a random start says little about f.
  /// After one of the objective alone, ρ begins with a tenth of what it was set to: f is nearly 0 then, and says less.
  Progress update() {
    if (lowest_ == std::numeric_limits<double>::infinity()) return Progress::nothing;
    lowest_ = std::numeric_limits<double>::infinity();
    if (problem_.constraints(point_.x, c_, {}).kind() == Status::Kind::failed) return Progress::nothing;
    if (first_ == First::objective_alone) {
      if (std::ranges::all_of(c_, [](double c) { return c + margin <= 0; })) return Progress::converged;
      first_ = First::penalised;
      penalty_ = std::max(0.1 * penalty_, least_penalty);
      measure_ = std::numeric_limits<double>::max();
      return Progress::going_on;
    }
    double measure = 0;
    for (std::size_t i = 0; i < c_.size(); ++i) {
      const double value = c_[i] + margin;
      measure = std::max(measure, std::abs(std::max(value, -multipliers_[i] / penalty_)));
      multipliers_[i] = std::clamp(multipliers_[i] + penalty_ * value, 0.0, largest_multiplier);
    }
    if (measure <= margin) return Progress::converged;
    const bool first = measure_ == std::numeric_limits<double>::infinity();
    if (first) penalty_ = initial_penalty(point_.objective);
    if (measure > 0.5 * measure_) {
      if (penalty_ >= largest_penalty) return point_.violation > 0 ? Progress::infeasible : Progress::converged;
      penalty_ *= 10;
    }
    measure_ = measure;
    return Progress::going_on;
  }

  [[nodiscard]] std::size_t dimension() const override { return n_; }
  [[nodiscard]] std::span<const double> start() const override { return problem_.start(); }
  [[nodiscard]] std::span<const ResidualBlock> blocks() const override { return blocks_; }
  [[nodiscard]] std::size_t residual_count() const override { return m_ + c_.size(); }
  [[nodiscard]] std::size_t constraint_count() const override { return 0; }
  Status constraints(std::span<const double>, std::span<double>, std::span<double>) override { return {}; }

  Status evaluate(std::span<const double> x, double& objective) override {
    return augmented(x, objective, problem_.evaluate(x, objective), {}, {});
  }
  void evaluate_batch(std::span<const double> xs, std::span<double> objectives, std::span<Status> statuses) override {
    problem_.evaluate_batch(xs, objectives, statuses);
    for (std::size_t k = 0; k < objectives.size(); ++k) {
      statuses[k] = augmented(xs.subspan(k * n_, n_), objectives[k], std::move(statuses[k]), {}, {});
    }
  }
  Status linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                   std::span<double> jacobian) override {
    Status status =
        problem_.linearise(x, objective, residuals.first(m_), jacobian.first(std::min(jacobian.size(), m_ * n_)));
    return augmented(x, objective, std::move(status), residuals.subspan(m_),
                     jacobian.empty() ? jacobian : jacobian.subspan(m_ * n_));
  }
  /// Each child begins with the multipliers and the penalty there are; point() and best() hear nothing of it.
  std::size_t for_each_start(std::size_t count, const std::function<void(std::size_t, Problem&)>& body) override {
    return problem_.for_each_start(count, [&](std::size_t k, Problem& child) {
      AugmentedLagrangian lagrangian(child, first_);
      lagrangian.multipliers_ = multipliers_;
      lagrangian.penalty_ = penalty_;
      body(k, lagrangian);
    });
  }

  [[nodiscard]] bool should_stop() const override { return problem_.should_stop(); }
  [[nodiscard]] std::uint64_t evaluations() const override { return problem_.evaluations(); }
  [[nodiscard]] std::uint64_t budget() const override { return problem_.budget(); }
  [[nodiscard]] std::uint64_t seed(std::string_view purpose) const override { return problem_.seed(purpose); }

 private:
  static constexpr double least_penalty = 1e-8, largest_penalty = 1e16, largest_multiplier = 1e20;

  /// Birgin & Martínez, section 12.4, without their unit of f: ρ = 10 |f| / max(1, ½ Σ max(0, c)²).
  double initial_penalty(double objective) const {
    double squares = 0;
    for (const double value : c_) squares += std::max(0.0, value) * std::max(0.0, value);
    return std::clamp(10 * std::abs(objective) / std::max(1.0, 0.5 * squares), least_penalty, 1e8);
  }

  Status augmented(std::span<const double> x, double& objective, Status status, std::span<double> residuals,
                   std::span<double> jacobian) {
    if (status.kind() == Status::Kind::failed) return status;
    const std::span<double> c_jacobian = jacobian.empty() ? std::span<double>{} : std::span<double>{c_jacobian_};
    Status known = problem_.constraints(x, c_, c_jacobian);
    if (known.kind() == Status::Kind::failed) return known;
    if (penalty_ == 0) penalty_ = initial_penalty(objective);
    const double f = objective, scale = std::sqrt(0.5 * penalty_);
    for (std::size_t i = 0; i < c_.size(); ++i) {
      const double r =
          first_ == First::objective_alone ? 0 : scale * std::max(0.0, c_[i] + margin + multipliers_[i] / penalty_);
      objective += r * r;
      if (!residuals.empty()) residuals[i] = r;
      for (std::size_t j = 0; j < n_ && !jacobian.empty(); ++j) {
        jacobian[i * n_ + j] = r > 0 ? scale * c_jacobian_[i * n_ + j] : 0;
      }
    }
    if (objective < lowest_) {
      lowest_ = objective;
      take(point_, x, f, status.violation());
    }
    const double violation = status.violation();
    if (violation != best_.violation ? violation < best_.violation : f < best_.objective) take(best_, x, f, violation);
    return {};
  }

  static void take(Point& point, std::span<const double> x, double objective, double violation) {
    point.x.assign(x.begin(), x.end());
    point.objective = objective;
    point.violation = violation;
  }

  Problem& problem_;
  First first_;
  std::vector<ResidualBlock> blocks_;
  std::size_t n_, m_;
  std::vector<double> c_, c_jacobian_, multipliers_;
  double penalty_ = 0;
  double measure_ = std::numeric_limits<double>::infinity();
  double lowest_ = std::numeric_limits<double>::infinity();
  Point point_, best_;
};

}  // namespace tunica
