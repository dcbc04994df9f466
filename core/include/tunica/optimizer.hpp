// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "tunica/status.hpp"

namespace tunica {

/// Rows [offset, offset + size) of the residual vector, entering the objective as weight · ρ(‖r‖²).
struct ResidualBlock {
  /// How the norm of a block enters the objective.
  enum class Loss { quadratic, root };  ///< ρ(s) = s; ρ(s) = √s, smoothed at zero as in Problem::root_smoothing
  std::size_t offset = 0,               ///< first row
      size = 0;                         ///< rows
  double weight = 1;                    ///< w > 0
  Loss loss = Loss::quadratic;          ///< ρ
};

/// The minimisation problem an optimiser is given, by the host. All x are in the unit box [0, 1]^n: the host maps
/// it to parameters (linearly or by logarithm). The objective is Σ w ρ(‖r‖²) over the residual blocks.
///
/// The host counts evaluations, keeps the best point (an optimiser's return value is advice), logs, and turns any
/// failure into a status; objectives are finite whenever the status is not `failed`. A point that breaks a constraint
/// is `infeasible`, with the sum of the positive c(x) as its violation, and never the best. Once should_stop() is true
/// every further evaluation is refused with status `failed` and not counted. Not thread-safe: parallel work goes
/// through evaluate_batch or for_each_start.
class Problem {
 public:
  static constexpr double root_smoothing = 1e-9;        ///< ρ(s) = √(s + ε²) − ε, ε in base units
  static constexpr double constraint_tolerance = 1e-6;  ///< a point is feasible where every c(x) is at most this

  virtual ~Problem() = default;
  [[nodiscard]] virtual std::size_t dimension() const = 0;          ///< n, the parameters that are searched
  [[nodiscard]] virtual std::span<const double> start() const = 0;  ///< initial point, n
  /// They cover the residuals without gap or overlap.
  [[nodiscard]] virtual std::span<const ResidualBlock> blocks() const = 0;
  [[nodiscard]] virtual std::size_t residual_count() const = 0;    ///< entries of the residual vector
  [[nodiscard]] virtual std::size_t constraint_count() const = 0;  ///< inequality constraints c(x) ≤ 0

  /// One evaluation. `objective` is set unless the status is failed; where a constraint is broken it may lack costly
  /// tests, and then compares with that of other such points only (Optimizer::Needs::infeasible).
  virtual Status evaluate(std::span<const double> x, double& objective) = 0;
  /// k evaluations side by side: xs is k·n, one point a row; objectives and statuses have k entries.
  virtual void evaluate_batch(std::span<const double> xs, std::span<double> objectives, std::span<Status> statuses) = 0;
  /// One evaluation with residuals (residual_count), and, unless empty, their Jacobian: ∂r_i/∂x_j at
  /// [i·n + j], row-major as Ceres wants it. A Jacobian is counted beside the evaluation.
  virtual Status linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                           std::span<double> jacobian) = 0;
  /// Constraint values (constraint_count) and, unless empty, their Jacobian [i·n + j]. Not an evaluation.
  virtual Status constraints(std::span<const double> x, std::span<double> values, std::span<double> jacobian) = 0;

  /// Independent searches: calls body(k, child) for k = 0 … count − 1, side by side where there are threads, each
  /// with a problem of its own. The outcome is that of running them one after the other, for any number of threads:
  /// it returns how many of them would have begun before the search had to stop. What a body found for a later k, or
  /// that it ran at all, depends on the clock and is to be forgotten.
  virtual std::size_t for_each_start(std::size_t count, const std::function<void(std::size_t, Problem&)>& body) = 0;

  [[nodiscard]] virtual bool should_stop() const = 0;           ///< budget or time is used up, or a person wants it
  [[nodiscard]] virtual std::uint64_t evaluations() const = 0;  ///< counted so far
  [[nodiscard]] virtual std::uint64_t budget() const = 0;       ///< evaluations that remain
  /// A seed for this task and purpose, the same for any number of threads: derive_seed(task seed, purpose).
  [[nodiscard]] virtual std::uint64_t seed(std::string_view purpose) const = 0;
};

/// Minimises a problem.
///
/// Required: needs, minimise. Threads: one minimise() per object at a time. Failure: evaluations may fail anywhere,
/// in any number; the optimiser survives and goes on as long as should_stop() is false. `minimise` returns when it
/// has converged or should_stop() turns true, with a word for the report.
class Optimizer {
 public:
  /// What it asks of a problem: the host refuses runs that cannot give it, before they begin.
  struct Needs {
    bool residuals = false;    ///< linearise() with residual blocks
    bool gradient = false;     ///< a Jacobian
    bool constraints = false;  ///< meets constraint_count() > 0; else a run with constraints is refused
    bool batch = false;        ///< uses evaluate_batch
    bool random = false;       ///< results depend on the seed
    /// Compares or combines objectives of feasible and infeasible points (augmented Lagrangian, stochastic ranking).
    /// Without it evaluate() leaves out costly tests where a constraint is broken; linearise() never does.
    bool infeasible = false;
    /// With its options it searches no more parameters than these (a small population spans no more); a run with more
    /// is refused.
    std::size_t most_parameters = std::numeric_limits<std::size_t>::max();
  };
  /// How the search ended. The point is not in it: the host has kept the best.
  struct Outcome {
    bool converged = false;  ///< by the method's own criterion, not by budget
    std::string reason;      ///< "step below tolerance", "restarts exhausted", "stopped"
  };
  virtual ~Optimizer() = default;
  [[nodiscard]] virtual const Needs& needs() const = 0;  ///< fixed by the options it was made with
  /// One search, from problem.start().
  virtual Outcome minimise(Problem& problem) = 0;
};

}  // namespace tunica
