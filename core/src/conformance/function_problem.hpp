// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tunica/optimizer.hpp"
#include "tunica/random.hpp"

namespace tunica::conformance {

/// A function over the unit box, written as residuals so that every kind of optimiser can be asked.
struct Function {
  std::string name;
  std::size_t dimension = 0, residual_count = 0;
  std::vector<ResidualBlock> blocks;
  /// Fills r (residual_count) and, unless empty, ∂r/∂x row-major; false = cannot be evaluated here.
  std::function<bool(std::span<const double> x, std::span<double> r, std::span<double> jacobian)> residuals;
  /// Inequality constraints c(x) ≤ 0: fills c (constraint_count) and, unless empty, ∂c/∂x row-major.
  std::size_t constraint_count = 0;
  std::function<void(std::span<const double> x, std::span<double> c, std::span<double> jacobian)> constraints = {};
  std::vector<double> start;  ///< in the unit box
  double optimum = 0;         ///< smallest objective in the box, of feasible points
};

/// A Problem over a Function, as strict as the host and more curious: it counts, remembers every point asked for,
/// and notes every breach of the contract instead of correcting it.
class FunctionProblem : public Problem {
 public:
  struct Settings {
    std::uint64_t budget = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t seed = 1;
    double target = -std::numeric_limits<double>::infinity();  ///< should_stop() once the objective is this small
    double failure_rate = 0;                                   ///< share of points that fail, chosen by their bits
    bool remember = false;                                     ///< keep every point in `asked`
    bool partial =
        false;  ///< evaluate() answers a hundredth of the objective at infeasible points: costly tests left out
    bool reverse = false;  ///< batches and starts are worked through backwards, as other threads might
  };

  FunctionProblem(Function function, Settings settings)
      : function_(std::move(function)),
        settings_(std::move(settings)),
        residuals_(function_.residual_count),
        c_(function_.constraint_count) {}

  std::vector<double> asked;       ///< every point evaluated, one after the other
  std::vector<double> best_point;  ///< best feasible point
  double best = std::numeric_limits<double>::infinity();
  std::uint64_t best_at = 0;  ///< evaluations made when it was found
  std::uint64_t jacobians = 0, failures = 0, batches = 0, infeasible = 0;
  double least_violation = std::numeric_limits<double>::infinity();  ///< of all points that were evaluated
  std::uint64_t constraint_jacobians = 0;
  std::uint64_t refused = 0;  ///< evaluations asked for after should_stop() or beyond the budget
  std::uint64_t outside = 0;  ///< points outside the unit box, or not finite
  double level = -std::numeric_limits<double>::infinity();
  std::uint64_t level_reached_at = 0;  ///< evaluations when the objective first was ≤ level; 0 = never

  [[nodiscard]] std::size_t dimension() const override { return function_.dimension; }
  [[nodiscard]] std::span<const double> start() const override { return function_.start; }
  [[nodiscard]] std::span<const ResidualBlock> blocks() const override { return function_.blocks; }
  [[nodiscard]] std::size_t residual_count() const override { return function_.residual_count; }
  [[nodiscard]] std::size_t constraint_count() const override { return function_.constraint_count; }

  Status evaluate(std::span<const double> x, double& objective) override {
    Status status = linearise(x, objective, residuals_, {});
    if (settings_.partial && status.kind() == Status::Kind::infeasible) objective *= 0.01;
    return status;
  }

  void evaluate_batch(std::span<const double> xs, std::span<double> objectives, std::span<Status> statuses) override {
    const std::size_t n = dimension(), count = objectives.size();
    ++batches;
    const bool stopped = should_stop();
    const std::uint64_t allowed = stopped ? 0 : std::min<std::uint64_t>(count, budget());
    if (settings_.remember)
      asked.insert(asked.end(), xs.begin(), xs.begin() + static_cast<std::ptrdiff_t>(allowed * n));
    const bool remember = std::exchange(settings_.remember, false);
    in_batch_ = true;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = settings_.reverse ? count - 1 - k : k;
      if (i >= allowed) {
        ++refused;
        statuses[i] = Status::failed("refused");
      } else {
        statuses[i] = evaluate(xs.subspan(i * n, n), objectives[i]);
      }
    }
    in_batch_ = false;
    settings_.remember = remember;
  }

  Status linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                   std::span<double> jacobian) override {
    if (!in_batch_ && should_stop()) {
      ++refused;
      return Status::failed("refused");
    }
    ++evaluations_;
    if (!jacobian.empty()) ++jacobians;
    if (settings_.remember) asked.insert(asked.end(), x.begin(), x.end());
    for (const double value : x) {
      if (!(value >= 0 && value <= 1)) {
        ++outside;
        return Status::failed("outside the box");
      }
    }
    if (fails(x) || !function_.residuals(x, residuals, jacobian)) {
      ++failures;
      return Status::failed("the function fails here");
    }
    objective = 0;
    for (const ResidualBlock& block : function_.blocks) {
      double s = 0;
      for (std::size_t i = 0; i < block.size; ++i) s += residuals[block.offset + i] * residuals[block.offset + i];
      const bool root = block.loss == ResidualBlock::Loss::root;
      objective += block.weight * (root ? std::sqrt(s + root_smoothing * root_smoothing) - root_smoothing : s);
    }
    if (const double violation = this->violation(x); violation > 0) {
      ++infeasible;
      least_violation = std::min(least_violation, violation);
      return Status::infeasible("a constraint is broken here", violation);
    }
    least_violation = 0;
    if (objective < best) {
      best = objective;
      best_at = evaluations_;
      best_point.assign(x.begin(), x.end());
      if (best <= level && level_reached_at == 0) level_reached_at = evaluations_;
    }
    return {};
  }

  Status constraints(std::span<const double> x, std::span<double> values, std::span<double> jacobian) override {
    if (!jacobian.empty()) ++constraint_jacobians;
    if (function_.constraint_count > 0) function_.constraints(x, values, jacobian);
    return {};
  }

  std::size_t for_each_start(std::size_t count, const std::function<void(std::size_t, Problem&)>& body) override {
    for (std::size_t k = 0; k < count; ++k) body(settings_.reverse ? count - 1 - k : k, *this);
    return count;
  }

  [[nodiscard]] bool should_stop() const override {
    return evaluations_ >= settings_.budget || best <= settings_.target;
  }
  [[nodiscard]] std::uint64_t evaluations() const override { return evaluations_; }
  [[nodiscard]] std::uint64_t budget() const override { return settings_.budget - evaluations_; }
  [[nodiscard]] std::uint64_t seed(std::string_view purpose) const override {
    return derive_seed(settings_.seed, purpose);
  }

 private:
  /// Σ of the positive constraint values where one is above the tolerance; else 0.
  double violation(std::span<const double> x) {
    if (function_.constraint_count == 0) return 0;
    function_.constraints(x, c_, {});
    double sum = 0;
    for (const double value : c_) sum += std::max(value, 0.0);
    return *std::max_element(c_.begin(), c_.end()) > constraint_tolerance ? sum : 0;
  }
  bool fails(std::span<const double> x) const {
    if (settings_.failure_rate <= 0) return false;
    std::uint64_t hash = settings_.seed;
    for (const double value : x) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      hash = derive_seed(hash ^ bits, "failure");
    }
    return static_cast<double>(hash >> 11) * 0x1p-53 < settings_.failure_rate;
  }

  Function function_;
  Settings settings_;
  std::vector<double> residuals_, c_;
  std::uint64_t evaluations_ = 0;
  bool in_batch_ = false;
};

}  // namespace tunica::conformance
