// SPDX-License-Identifier: Apache-2.0
// Optimisers that declare that they meet constraints.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "conformance/constrained_functions.hpp"
#include "conformance/searches.hpp"

namespace tunica::conformance {
namespace {

bool meets_constraints(const Candidate& candidate, std::size_t parameters) {
  const Optimizer::Needs needs = candidate.make()->needs();
  return needs.constraints && needs.most_parameters >= parameters;
}
constexpr const char* meets_none = "it declares that it meets no constraints";

/// The best feasible objective above the least there is, relative to it.
void see_closeness(Meter& meter, const Candidate& candidate, const Function& function, bool partial = false) {
  FunctionProblem problem(function, {.budget = candidate.budget, .partial = partial});
  const auto outcome = search(candidate, problem);
  if (problem.best_point.empty()) {
    meter.see(std::numeric_limits<double>::infinity(),
              [&] { return fmt::format("{}: no feasible point was found{}", function.name, ended(outcome)); });
    return;
  }
  meter.see(problem.best / function.optimum - 1, [&] {
    return fmt::format("{}: {:.9g} is the best feasible objective, {:.9g} can be had{}", function.name, problem.best,
                       function.optimum, ended(outcome));
  });
}

}  // namespace

Verdict prefers_feasible_points(const Candidate& candidate, std::uint64_t) {
  Meter meter("the best feasible objective of half a sphere with its optimum", candidate.boundary);
  if (!meets_constraints(candidate, 2)) return not_checked(meter.verdict().compared, meets_none);
  see_closeness(meter, candidate, half_sphere());
  return meter.verdict();
}

Verdict reaches_the_boundary_of_what_is_feasible(const Candidate& candidate, std::uint64_t) {
  Meter meter("the best feasible objectives with optima that lie on constraints", candidate.boundary);
  if (!meets_constraints(candidate, 4)) return not_checked(meter.verdict().compared, meets_none);
  for (const Function& function : {hock_schittkowski_65(), rosenbrock_in_disc(), limited_curve()})
    if (candidate.oblique || function.name == "hock_schittkowski_65") see_closeness(meter, candidate, function);
  return meter.verdict();
}

Verdict is_not_misled_where_costly_tests_are_left_out(const Candidate& candidate, std::uint64_t) {
  Meter meter("the best feasible objective, where infeasible points answer with less than their own, with its optimum",
              candidate.boundary);
  if (!meets_constraints(candidate, 3)) return not_checked(meter.verdict().compared, meets_none);
  if (candidate.make()->needs().infeasible)
    return not_checked(meter.verdict().compared, "it needs objectives of infeasible points in full, and says so");
  see_closeness(meter, candidate, hock_schittkowski_65(), true);
  return meter.verdict();
}

Verdict says_so_where_nothing_is_feasible(const Candidate& candidate, std::uint64_t) {
  Meter meter("the least violation with 0.1, not converged, where nothing is feasible", candidate.boundary);
  if (!meets_constraints(candidate, 2)) return not_checked(meter.verdict().compared, meets_none);
  FunctionProblem problem(nothing_feasible(), {.budget = 20000});
  const auto outcome = search(candidate, problem);
  if (outcome.converged) return broken(meter.verdict().compared, "it calls that converged" + ended(outcome));
  meter.see(std::abs(problem.least_violation - 0.1), [&] {
    return fmt::format("the least violation it came to is {:.6g}{}", problem.least_violation, ended(outcome));
  });
  return meter.verdict();
}

const std::vector<OptimizerProperty>& optimizer_properties() {
  static const std::vector<OptimizerProperty> properties{
      {"finds_a_smooth_optimum", finds_a_smooth_optimum},
      {"follows_a_curved_valley", follows_a_curved_valley, true},
      {"evaluates_once_when_nothing_is_free", evaluates_once_when_nothing_is_free},
      {"keeps_the_bounds", keeps_the_bounds},
      {"keeps_the_budget", keeps_the_budget},
      {"stops_at_the_target", stops_at_the_target},
      {"asks_for_what_it_declares", asks_for_what_it_declares},
      {"repeats_itself_with_the_same_seed", repeats_itself_with_the_same_seed},
      {"takes_another_course_with_another_seed", takes_another_course_with_another_seed},
      {"does_not_depend_on_the_order_of_parallel_work", does_not_depend_on_the_order_of_parallel_work},
      {"survives_failed_evaluations", survives_failed_evaluations},
      {"gives_up_when_nothing_can_be_evaluated", gives_up_when_nothing_can_be_evaluated},
      {"prints_nothing", prints_nothing},
      {"prefers_feasible_points", prefers_feasible_points},
      {"reaches_the_boundary_of_what_is_feasible", reaches_the_boundary_of_what_is_feasible, true},
      {"is_not_misled_where_costly_tests_are_left_out", is_not_misled_where_costly_tests_are_left_out},
      {"says_so_where_nothing_is_feasible", says_so_where_nothing_is_feasible}};
  return properties;
}

}  // namespace tunica::conformance
