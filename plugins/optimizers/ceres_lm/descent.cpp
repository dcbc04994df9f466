// SPDX-License-Identifier: Apache-2.0
#include "descent.hpp"

#include <algorithm>
#include <cmath>

#include <ceres/ceres.h>

#include "tunica/optimizers/augmented_lagrangian.hpp"

namespace tunica::ceres_lm {
namespace {

/// Residuals and Jacobian at the last two points asked for. Ceres asks for the costs of a trial point first and for
/// derivatives once it is accepted, block by block; all of these are one evaluation of the problem. At bounds it looks
/// at a shorter step, too, and may come back. The Jacobian is always taken along: most trial points are accepted, and
/// exact Jacobians cost half an evaluation or less.
class LastPoints {
 public:
  LastPoints(Problem& problem, Descent& descent) : problem_(problem), descent_(descent) {
    for (Point* point : {&last_, &before_}) {
      point->residuals.resize(problem.residual_count());
      point->jacobian.resize(problem.residual_count() * problem.dimension());
    }
  }

  /// False when the point cannot be evaluated, or the problem has stopped.
  bool move_to(std::span<const double> x) {
    if (std::ranges::equal(x, last_.x)) return last_.usable;
    if (std::ranges::equal(x, before_.x)) {
      std::swap(last_, before_);
      return last_.usable;
    }
    if (problem_.should_stop()) return false;
    std::swap(last_, before_);
    last_.x.assign(x.begin(), x.end());
    double objective = 0;
    const Status status = problem_.linearise(x, objective, last_.residuals, last_.jacobian);
    last_.usable = status.kind() != Status::Kind::failed;
    if (!last_.usable) {
      descent_.failure = status.reason();
    } else if (!descent_.evaluated || objective < descent_.objective) {
      descent_.x = last_.x;
      descent_.objective = objective;
      descent_.evaluated = true;
    }
    return last_.usable;
  }
  [[nodiscard]] std::span<const double> residuals() const { return last_.residuals; }
  [[nodiscard]] std::span<const double> jacobian() const { return last_.jacobian; }

 private:
  struct Point {
    std::vector<double> x, residuals, jacobian;
    bool usable = false;
  };

  Problem& problem_;
  Descent& descent_;
  Point last_, before_;
};

class BlockCost : public ceres::CostFunction {
 public:
  BlockCost(LastPoints& last, const ResidualBlock& block, std::size_t n) : last_(last), block_(block), n_(n) {
    set_num_residuals(static_cast<int>(block.size));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(n));
  }
  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    if (!last_.move_to({parameters[0], n_})) return false;
    std::ranges::copy(last_.residuals().subspan(block_.offset, block_.size), residuals);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      std::ranges::copy(last_.jacobian().subspan(block_.offset * n_, block_.size * n_), jacobians[0]);
    }
    return true;
  }

 private:
  LastPoints& last_;
  const ResidualBlock block_;
  const std::size_t n_;
};

/// 2 w ρ(s), since Ceres halves: its cost is then the objective. ρ(s) = s, or ρ(s) = √(s + ε²) − ε with
/// ρ' = 1/(2√(s + ε²)), ρ'' = −1/(4 (s + ε²)^(3/2)).
///
/// Where ρ'' < 0 Ceres leaves the second-order term out (its Corrector, after Triggs et al. 2000), which amounts to
/// iteratively reweighted least squares. Residuals √(2w‖r‖) r/‖r‖, whose Gauss–Newton matrix has half of that term,
/// were tried on the lamb aorta and gained nothing: see docs/optimizers.md.
class BlockLoss : public ceres::LossFunction {
 public:
  explicit BlockLoss(const ResidualBlock& block)
      : weight_(block.weight), root_(block.loss == ResidualBlock::Loss::root) {}
  void Evaluate(double s, double rho[3]) const override {
    constexpr double e = Problem::root_smoothing;
    const double root = std::sqrt(s + e * e);
    rho[0] = 2 * weight_ * (root_ ? root - e : s);
    rho[1] = 2 * weight_ * (root_ ? 0.5 / root : 1);
    rho[2] = 2 * weight_ * (root_ ? -0.25 / (root * root * root) : 0);
  }

 private:
  const double weight_;
  const bool root_;
};

/// Ends a minimisation when the problem stops, or when its best point has stayed at bounds for some iterations.
class Observer : public ceres::IterationCallback {
 public:
  Observer(const Problem& problem, const Descent& descent, const std::vector<int>& held)
      : problem_(problem), descent_(descent), held_(held) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override {
    iterations = iteration.iteration;
    if (problem_.should_stop()) return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    at_bounds_ = at_new_bounds() ? at_bounds_ + 1 : 0;
    lingers = at_bounds_ >= 10;
    return lingers ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }
  int iterations = 0;
  bool lingers = false;

 private:
  [[nodiscard]] bool at_new_bounds() const {
    for (std::size_t j = 0; j < descent_.x.size(); ++j)
      if ((descent_.x[j] <= 0 || descent_.x[j] >= 1) &&
          std::find(held_.begin(), held_.end(), static_cast<int>(j)) == held_.end())
        return true;
    return false;
  }

  const Problem& problem_;
  const Descent& descent_;
  const std::vector<int>& held_;
  int at_bounds_ = 0;
};

ceres::Solver::Options solver_options(int max_iterations, const Settings& settings) {
  ceres::Solver::Options chosen;
  chosen.linear_solver_type = ceres::DENSE_QR;
  chosen.num_threads = 1;  // the host runs starts side by side
  chosen.logging_type = ceres::SILENT;
  chosen.max_num_iterations = max_iterations;
  chosen.max_num_consecutive_invalid_steps = 10;
  // Measured on 300 random starts of the lamb aorta: Ceres' own values (1e4 and 20) need 60 % more evaluations a
  // success, as the first, nearly undamped steps jump to the bounds and the line search along the box lingers there.
  chosen.initial_trust_region_radius = 10;
  chosen.max_num_line_search_step_size_iterations = 2;
  chosen.function_tolerance = settings.function_tolerance;
  chosen.gradient_tolerance = settings.gradient_tolerance;
  chosen.parameter_tolerance = settings.parameter_tolerance;
  return chosen;
}

Descent::End end_of(const ceres::Solver::Summary& summary, const Problem& problem, const Descent& descent) {
  if (summary.termination_type == ceres::CONVERGENCE) return Descent::End::converged;
  if (problem.should_stop()) return Descent::End::stopped;
  if (summary.termination_type == ceres::NO_CONVERGENCE) return Descent::End::out_of_iterations;
  return descent.evaluated ? Descent::End::blocked : Descent::End::not_started;
}

/// The coordinates whose bound the objective pushes against at the descent's point, by the sign of its derivative.
std::vector<int> held_by_bounds(const Problem& problem, LastPoints& last, const Descent& descent) {
  const bool inside = std::ranges::all_of(descent.x, [](double value) { return value > 0 && value < 1; });
  if (inside || !last.move_to(descent.x)) return {};
  const std::size_t n = problem.dimension();
  std::vector<double> gradient(n, 0.0);
  for (const ResidualBlock& block : problem.blocks()) {
    double squares = 0;
    for (std::size_t i = block.offset; i < block.offset + block.size; ++i)
      squares += last.residuals()[i] * last.residuals()[i];
    double rho[3];
    BlockLoss(block).Evaluate(squares, rho);
    for (std::size_t i = block.offset; i < block.offset + block.size; ++i)
      for (std::size_t j = 0; j < n; ++j) gradient[j] += rho[1] * last.residuals()[i] * last.jacobian()[i * n + j];
  }
  std::vector<int> held;
  for (std::size_t j = 0; j < n; ++j)
    if ((descent.x[j] <= 0 && gradient[j] > 0) || (descent.x[j] >= 1 && gradient[j] < 0))
      held.push_back(static_cast<int>(j));
  return held;
}

/// Within bounds alone. `iterations` is lowered by those made.
///
/// Ceres cuts a step off at the bounds after solving for it, so that a coordinate at its bound goes on bending the step
/// of the others; along a valley the rest is no descent, the trust region shrinks, and the search ends short of the
/// optimum. It is therefore continued with the coordinates that push against their bounds held, as long as that leads
/// on; whoever pushes no more is set free.
Descent descend_in_box(Problem& problem, std::span<const double> x, int& iterations, const Settings& settings) {
  const std::size_t n = problem.dimension();
  Descent descent{.x = {x.begin(), x.end()}};
  if (problem.should_stop()) return descent;
  LastPoints last(problem, descent);
  std::vector<int> held;
  for (int round = 0; round < 20 && iterations > 0; ++round) {
    const double before = descent.objective;
    std::vector<double> point(descent.x);
    ceres::Problem least_squares;
    for (const ResidualBlock& block : problem.blocks()) {
      if (block.size == 0) continue;
      least_squares.AddResidualBlock(new BlockCost(last, block, n), new BlockLoss(block), point.data());
    }
    for (int j = 0; j < static_cast<int>(n); ++j) {
      least_squares.SetParameterLowerBound(point.data(), j, 0);
      least_squares.SetParameterUpperBound(point.data(), j, 1);
    }
    if (!held.empty()) least_squares.SetManifold(point.data(), new ceres::SubsetManifold(static_cast<int>(n), held));
    Observer observer(problem, descent, held);
    ceres::Solver::Options chosen = solver_options(iterations, settings);
    chosen.callbacks.push_back(&observer);
    ceres::Solver::Summary summary;
    ceres::Solve(chosen, &least_squares, &summary);
    descent.end = end_of(summary, problem, descent);
    iterations -= std::max(1, observer.iterations);
    if (descent.end != Descent::End::converged && !observer.lingers) break;
    const bool stuck = round > 0 && before - descent.objective <= settings.function_tolerance * std::abs(before);
    std::vector<int> holding = held_by_bounds(problem, last, descent);
    const bool settled = holding.size() == n || (holding == held && (stuck || !observer.lingers));
    descent.end = settled ? Descent::End::converged : Descent::End::out_of_iterations;
    if (settled) break;
    held = std::move(holding);
  }
  return descent;
}

/// The first minimisations need not be more exact than the multipliers are (Nocedal & Wright 2006, framework 17.3).
double looseness(int round) { return 1e-3 * std::pow(0.01, round); }

Settings loosened(const Settings& settings, int round) {
  Settings loose = settings;
  loose.function_tolerance = std::max(settings.function_tolerance, looseness(round));
  loose.parameter_tolerance = std::max(settings.parameter_tolerance, looseness(round));
  return loose;
}

bool exact(const Settings& settings, int round) {
  return looseness(round) <= std::max(settings.function_tolerance, settings.parameter_tolerance);
}

}  // namespace

Descent descend(Problem& problem, std::span<const double> x, int max_iterations, const Settings& settings) {
  if (problem.constraint_count() == 0) return descend_in_box(problem, x, max_iterations, settings);
  AugmentedLagrangian lagrangian(problem, AugmentedLagrangian::First::objective_alone);
  Descent descent{.x = {x.begin(), x.end()}};
  max_iterations *= 5;  // a descent is several minimisations then
  for (int round = 0; max_iterations > 0; ++round) {
    const std::vector<double> from = round == 0 ? descent.x : lagrangian.point().x;
    const Descent last = descend_in_box(lagrangian, from, max_iterations, loosened(settings, round));
    descent.failure = last.failure;
    descent.end = last.end;
    if (last.end == Descent::End::stopped || (last.end == Descent::End::not_started && round == 0)) break;
    const AugmentedLagrangian::Progress progress = lagrangian.update();
    if (progress == AugmentedLagrangian::Progress::converged && exact(settings, round)) break;
    if (progress == AugmentedLagrangian::Progress::infeasible) descent.end = Descent::End::infeasible;
    if (progress == AugmentedLagrangian::Progress::nothing) descent.end = Descent::End::blocked;
    if (descent.end == Descent::End::infeasible || descent.end == Descent::End::blocked) break;
    descent.end = Descent::End::out_of_iterations;
  }
  descent.evaluated = !lagrangian.best().x.empty();
  if (!descent.evaluated) return descent;
  descent.x = lagrangian.best().x;
  descent.objective = lagrangian.best().objective;
  descent.violation = lagrangian.best().violation;
  return descent;
}

}  // namespace tunica::ceres_lm
