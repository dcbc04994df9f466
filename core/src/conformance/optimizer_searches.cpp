// SPDX-License-Identifier: Apache-2.0
// What an optimiser finds, and that it stays where it is told to.
#include <cmath>

#include <fmt/format.h>

#include "conformance/constrained_functions.hpp"
#include "conformance/searches.hpp"

namespace tunica::conformance {
namespace {

/// Σ (y_i − c_i)² on [−2, 3]³ with c = (5, −4, 0.5): the optimum in the box is (3, −2, 0.5), objective 8.
Function corner() {
  return least_squares("corner", 3, 3, -2, 3, [](const auto& y, std::span<double> r, std::span<double> jacobian) {
    constexpr double centre[] = {5, -4, 0.5};
    for (std::size_t i = 0; i < 3; ++i) {
      r[i] = y[i] - centre[i];
      if (!jacobian.empty()) jacobian[i * 3 + i] = 1;
    }
  });
}

}  // namespace

Verdict solves(const Candidate& candidate, Function function) {
  Meter meter(fmt::format("the least objective with the optimum, 0, of a {}", function.name), candidate.accuracy);
  const std::size_t n = function.dimension;
  FunctionProblem problem(std::move(function), {.budget = candidate.budget, .target = candidate.accuracy});
  const auto outcome = search(candidate, problem);
  meter.see(problem.best, [&] {
    return fmt::format("{:.3g} is the best of {} evaluations of {} parameters{}", problem.best, problem.evaluations(),
                       n, ended(outcome));
  });
  meter.note(fmt::format("{} evaluations", problem.evaluations()));
  return meter.verdict();
}

Verdict finds_a_smooth_optimum(const Candidate& candidate, std::uint64_t) {
  if (Verdict one = solves(candidate, sphere(1)); !one.held()) return one;
  return solves(candidate, sphere(dimensions(candidate, 4)));
}

Verdict follows_a_curved_valley(const Candidate& candidate, std::uint64_t) {
  const std::string compared = "the least objective with the optimum, 0, of Rosenbrock's valley";
  if (!candidate.oblique) return not_checked(compared, "adapts to no directions");
  if (dimensions(candidate, 2) < 2) return not_checked(compared, "it searches one parameter only");
  return solves(candidate, rosenbrock(2));
}

Verdict evaluates_once_when_nothing_is_free(const Candidate& candidate, std::uint64_t) {
  const std::string compared = "evaluations of a problem without parameters with one";
  FunctionProblem problem(sphere(0), {});
  const auto outcome = search(candidate, problem);
  if (problem.evaluations() != 1) return broken(compared, fmt::format("it makes {}", problem.evaluations()));
  if (!outcome.converged) return broken(compared, "it does not call that converged" + ended(outcome));
  return {.compared = compared};
}

Verdict keeps_the_bounds(const Candidate& candidate, std::uint64_t) {
  Meter meter("the best objective with that in a corner of the box, all points with the box", 1e-3);
  FunctionProblem problem(corner(), {.budget = candidate.budget});
  const auto outcome = search(candidate, problem);
  FunctionProblem wide(rastrigin(dimensions(candidate, 3)), {.budget = 5000});
  search(candidate, wide);
  if (const std::uint64_t outside = problem.outside + wide.outside; outside > 0)
    return broken(meter.verdict().compared,
                  fmt::format("{} of {} points asked for lie outside the unit box, or are no numbers", outside,
                              problem.evaluations() + wide.evaluations()));
  meter.see(std::abs(problem.best - 8), [&] {
    return fmt::format("the best objective is {:.9g}, in the corner of the box it is 8{}", problem.best,
                       ended(outcome));
  });
  return meter.verdict();
}

Verdict keeps_the_budget(const Candidate& candidate, std::uint64_t) {
  const std::string compared = "evaluations with budgets of 0 to 500, and none after should_stop()";
  for (const std::uint64_t budget : {0u, 1u, 2u, 17u, 119u, 121u, 500u}) {
    FunctionProblem problem(rosenbrock(std::max<std::size_t>(2, dimensions(candidate, 4))),
                            {.budget = budget, .failure_rate = 0.1});
    const auto outcome = search(candidate, problem);
    if (problem.refused > 0 || problem.evaluations() > budget)
      return broken(compared,
                    fmt::format("with a budget of {} it asked for {} evaluations more", budget,
                                problem.refused + problem.evaluations() - std::min(budget, problem.evaluations())));
    if (outcome.reason.empty()) return broken(compared, fmt::format("stopped after {} it gives no reason", budget));
  }
  return {.compared = compared};
}

Verdict stops_at_the_target(const Candidate& candidate, std::uint64_t) {
  const std::string compared = "the end of a search with reaching the target objective";
  FunctionProblem problem(sphere(dimensions(candidate, 4)), {.budget = candidate.budget, .target = 1e-3});
  const auto outcome = search(candidate, problem);
  if (!(problem.best <= 1e-3))
    return broken(compared, fmt::format("the target 1e-3 is not reached, {:.3g} is{}", problem.best, ended(outcome)));
  if (problem.refused > 0)
    return broken(compared, fmt::format("{} evaluations were asked for after it", problem.refused));
  return {.compared = compared};
}

Verdict asks_for_what_it_declares(const Candidate& candidate, std::uint64_t) {
  const std::string compared = "calls of the problem with needs()";
  const Optimizer::Needs needs = candidate.make()->needs();
  const std::size_t n = std::max<std::size_t>(2, dimensions(candidate, 2));
  for (Function function : {sphere(n), half_sphere()}) {
    if (function.constraint_count > 0 && !needs.constraints) continue;
    FunctionProblem problem(std::move(function), {.budget = 5000});
    const auto outcome = search(candidate, problem);
    if (!needs.gradient && problem.jacobians > 0) return broken(compared, "a Jacobian, and gradient is not declared");
    if (!(needs.gradient && needs.constraints) && problem.constraint_jacobians > 0)
      return broken(compared, "a Jacobian of the constraints, and gradient or constraints are not declared");
    if (!needs.batch && problem.batches > 0) return broken(compared, "evaluate_batch, and batch is not declared");
    if (outcome.reason.empty()) return broken(compared, "the outcome has no reason");
  }
  return {.compared = compared};
}

}  // namespace tunica::conformance
