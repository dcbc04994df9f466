// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <limits>
#include <string>
#include <vector>

#include <nlopt.hpp>

#include "tunica/optimizer.hpp"

namespace tunica::nlopt_plugin {

/// The best point of a search: feasible before infeasible, infeasible ones by violation, then by objective.
struct Point {
  std::vector<double> x;  ///< empty: nothing could be evaluated
  double objective = std::numeric_limits<double>::infinity();
  double violation = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool better_than(const Point& other) const {
    return violation != other.violation ? violation < other.violation : objective < other.objective;
  }
};

/// How points that break a constraint look to an algorithm.
enum class Infeasible {
  as_is,   ///< their objective; the algorithm is told the constraints
  ranked,  ///< behind all feasible ones, by violation: −1/f, and the violation, which keep the order and all digits
};

/// How points that cannot be evaluated look to an algorithm.
enum class Failed {
  infinite,  ///< +∞: the algorithm only compares
  worst,     ///< the worst value so far
  beyond,    ///< far behind the worst value so far, so that a line search shortens its step
  nearer     ///< the value halfway, or further, to the best point, which a model can follow
};

/// The problem as NLopt's callbacks. No exception passes through NLopt: one is kept, the search is stopped, and
/// rethrow() throws it. A search ends when the problem stops, when it made no progress for `stall` evaluations, when
/// nothing can be evaluated, or when NLopt asks for a point that is not a number, which SLSQP does once its quadratic
/// model is lost, and from then on for ever.
class Bridge {
 public:
  struct Rules {
    bool gradient = false;
    Infeasible infeasible = Infeasible::as_is;
    Failed failed = Failed::worst;
    std::size_t stall = 0;  ///< 0 = no such end
    double tolerance = 0;   ///< relative improvement that counts as progress
  };
  enum class Stop { none, problem, stalled, nothing_succeeded, not_a_number };
  static constexpr std::size_t gives_up_after = 2000;  ///< evaluations, all failed

  Bridge(Problem& problem, Rules rules);

  /// Hands objective, box and, where the problem has any and `constraints` says so, constraints to `opt`.
  void attach(nlopt::opt& opt, bool constraints);
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

  [[nodiscard]] const Point& best() const { return best_; }
  [[nodiscard]] Stop stop() const { return stop_; }
  [[nodiscard]] const std::string& failure() const { return failure_; }
  [[nodiscard]] std::size_t evaluated() const { return evaluated_; }

 private:
  static double objective(unsigned n, const double* x, double* gradient, void* self);
  static void constraints(unsigned m, double* values, unsigned n, const double* x, double* jacobian, void* self);
  double value_at(const double* x, double* gradient);
  void constraints_at(const double* x, double* values, double* jacobian);
  void move_to(const double* x);
  Status evaluate(std::span<const double> x);
  double value_of(std::span<const double> x, const Status& status, double objective);
  double value_of_failure(const Status& status);
  void note_progress();
  void halt(Stop reason);

  Problem& problem_;
  const Rules rules_;
  nlopt::opt* opt_ = nullptr;
  std::vector<double> x_, nearer_, residuals_, jacobian_, gradient_;
  double value_ = 0, worst_ = 0;
  double scale_ = 0;    ///< what value and gradient are divided by; 0 = nothing was evaluated yet
  bool known_ = false;  ///< value_ and gradient_ belong to x_
  Point best_;
  double progress_from_ = std::numeric_limits<double>::infinity();
  double violation_from_ = std::numeric_limits<double>::infinity();
  std::size_t evaluated_ = 0, progress_at_ = 0;
  Stop stop_ = Stop::none;
  std::string failure_;
  std::exception_ptr thrown_;
};

}  // namespace tunica::nlopt_plugin
