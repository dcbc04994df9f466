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

/// Rows [offset, offset + size) of the residual vector. They enter the objective as weight · ρ(‖r‖²).
struct ResidualBlock {
  /// How the norm of a block enters the objective.
  enum class Loss {
    quadratic,  ///< ρ(s) = s: least squares
    root        ///< ρ(s) = √s, the norm itself; smoothed at zero, see Problem::root_smoothing
  };
  std::size_t offset = 0,       ///< first row
      size = 0;                 ///< number of rows
  double weight = 1;            ///< w > 0
  Loss loss = Loss::quadratic;  ///< ρ
};

/// The minimisation problem that the host gives to an optimizer.
///
/// Mathematics: minimise f(x) = Σ_b w_b ρ_b(‖r_b(x)‖²) over x in the unit box [0, 1]^n, subject to c(x) ≤ 0. The host
/// maps the box to parameters, linearly or by logarithm, so that all directions have a comparable scale.
///
/// What the host does: it counts evaluations, keeps the best feasible point, writes the journal and turns every failure
/// into a status. The objective is finite whenever the status is not `failed`. A point that violates a constraint is
/// `infeasible`; Status::violation() is the sum of its positive c(x). Once should_stop() is true, the host refuses
/// further evaluations with status `failed` and does not count them.
///
/// Threads: not thread-safe. Parallel work goes through evaluate_batch(), evaluate_best() or for_each_start(), whose
/// results are the same for any number of threads.
class Problem {
 public:
  static constexpr double root_smoothing = 1e-9;        ///< ε in ρ(s) = √(s + ε²) − ε, in base units
  static constexpr double constraint_tolerance = 1e-6;  ///< a point is feasible if every c(x) is at most this

  virtual ~Problem() = default;
  /// n, the number of parameters that are searched; 0 if the experiment fixes all of them.
  [[nodiscard]] virtual std::size_t dimension() const = 0;
  /// The initial values, n entries.
  [[nodiscard]] virtual std::span<const double> start() const = 0;
  /// The residual blocks. They cover all residuals without gap or overlap.
  [[nodiscard]] virtual std::span<const ResidualBlock> blocks() const = 0;
  /// The number of residuals.
  [[nodiscard]] virtual std::size_t residual_count() const = 0;
  /// The number of inequality constraints c(x) ≤ 0.
  [[nodiscard]] virtual std::size_t constraint_count() const = 0;

  /// Evaluates one point and sets `objective` unless the status is failed. At a point that violates a constraint the
  /// objective may lack costly tests. It is then comparable with those of other such points only, see
  /// Optimizer::Needs::infeasible.
  virtual Status evaluate(std::span<const double> x, double& objective) = 0;
  /// Evaluates k points in parallel. `xs` has k·n entries, one point a row; the outputs have k entries. The budget
  /// counts every point.
  virtual void evaluate_batch(std::span<const double> xs, std::span<double> objectives, std::span<Status> statuses) = 0;
  /// As evaluate_batch(), for a search that ranks the points and keeps at most `best` of them, 1 or more.
  ///
  /// The host may end the evaluation of a feasible point early, once its cheap tests alone make it worse than `best`
  /// others of the batch. Its status is then `ok`, and its objective is a lower bound above those of the `best` lowest.
  /// The `best` lowest and their order are therefore those of evaluate_batch(). The budget counts every point.
  virtual void evaluate_best(std::span<const double> xs, [[maybe_unused]] std::size_t best,
                             std::span<double> objectives, std::span<Status> statuses) {
    evaluate_batch(xs, objectives, statuses);
  }
  /// Evaluates one point with its residuals and, unless `jacobian` is empty, ∂r_i/∂x_j at [i·n + j] (row-major, as
  /// Ceres wants it). A Jacobian is counted in addition to the evaluation.
  virtual Status linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                           std::span<double> jacobian) = 0;
  /// Sets the constraint values and, unless `jacobian` is empty, ∂c_i/∂x_j at [i·n + j]. It is not an evaluation.
  virtual Status constraints(std::span<const double> x, std::span<double> values, std::span<double> jacobian) = 0;

  /// Runs independent searches: calls body(k, child) for k = 0 … count − 1, in parallel if there are threads, and gives
  /// each its own problem. The result is that of running them one after the other.
  ///
  /// Returns how many of them would have begun before the search had to stop. Discard what a body found for a later k:
  /// whether it ran at all depends on the clock.
  virtual std::size_t for_each_start(std::size_t count, const std::function<void(std::size_t, Problem&)>& body) = 0;

  /// Whether to end: budget or time is used up, the target is reached, or a person interrupted the run.
  [[nodiscard]] virtual bool should_stop() const = 0;
  /// The number of evaluations counted so far.
  [[nodiscard]] virtual std::uint64_t evaluations() const = 0;
  /// The number of evaluations that remain.
  [[nodiscard]] virtual std::uint64_t budget() const = 0;
  /// A seed for a generator of random numbers, see derive_seed(). It depends on the task and on `purpose` alone.
  [[nodiscard]] virtual std::uint64_t seed(std::string_view purpose) const = 0;
};

/// Minimises a problem.
///
/// Required: needs() and minimise(). The host makes a new object for every search, so scratch in members is welcome.
/// Randomness: seed every generator with Problem::seed() and with nothing else. Results are resumed by repeating the
/// search, so equal seeds must give equal points, bit for bit.
/// Failure: evaluations may fail anywhere and in any number; the search goes on as long as should_stop() is false. Do
/// not throw.
/// Threads: the host calls minimise() once at a time for each object.
class Optimizer {
 public:
  /// What the optimizer asks of a problem. The host refuses a run that cannot offer it, before the run begins.
  struct Needs {
    bool residuals = false;    ///< calls linearise() and uses the residual blocks
    bool gradient = false;     ///< wants Jacobians from linearise() or constraints()
    bool constraints = false;  ///< handles constraint_count() > 0; otherwise a run with constraints is refused
    bool batch = false;        ///< calls evaluate_batch() or evaluate_best()
    bool random = false;       ///< results depend on the seed
    /// Compares or combines objectives of feasible and infeasible points, as augmented Lagrangians and stochastic
    /// ranking do. Without it evaluate() leaves out costly tests where a constraint is violated; linearise() never
    /// does.
    bool infeasible = false;
    /// The largest number of parameters that it searches with its options; a run with more is refused.
    std::size_t most_parameters = std::numeric_limits<std::size_t>::max();
  };
  /// The end of a search. It contains no point, because the host keeps the best one.
  struct Outcome {
    bool converged = false;  ///< whether the method's own criterion ended it, not the budget
    std::string reason;      ///< for the report, for example "step below tolerance"
  };
  virtual ~Optimizer() = default;
  /// The needs of this object. Its options determine them, so it returns a member.
  [[nodiscard]] virtual const Needs& needs() const = 0;
  /// Searches from problem.start(). Returns when it has converged, or soon after should_stop() turns true.
  virtual Outcome minimise(Problem& problem) = 0;
};

}  // namespace tunica
