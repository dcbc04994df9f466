// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "conformance/functions.hpp"
#include "conformance/verdict.hpp"
#include "tunica/optimizer.hpp"

/// The properties every Optimizer must have. What each means for an author: docs/plugin-check.md.
namespace tunica::conformance {

/// An optimiser and its expected properties.
struct Candidate {
  std::function<std::unique_ptr<Optimizer>()> make;
  std::uint64_t budget = 60000;  ///< evaluations that suffice for each of the standard functions
  double accuracy = 1e-6;        ///< of the objective at a smooth optimum
  double boundary = 1e-2;        ///< expected relative closeness to an optimum on the boundary of the feasible set
  bool oblique = true;           ///< adapts to directions, or to curved valleys
};

/// Least objective found of a function whose optimum is zero, within the budget.
Verdict solves(const Candidate& candidate, Function function);

Verdict finds_a_smooth_optimum(const Candidate& candidate, std::uint64_t seed = 1);
Verdict follows_a_curved_valley(const Candidate& candidate, std::uint64_t seed = 1);
Verdict evaluates_once_when_nothing_is_free(const Candidate& candidate, std::uint64_t seed = 1);
Verdict keeps_the_bounds(const Candidate& candidate, std::uint64_t seed = 1);
Verdict keeps_the_budget(const Candidate& candidate, std::uint64_t seed = 1);
Verdict stops_at_the_target(const Candidate& candidate, std::uint64_t seed = 1);
Verdict asks_for_what_it_declares(const Candidate& candidate, std::uint64_t seed = 1);

Verdict repeats_itself_with_the_same_seed(const Candidate& candidate, std::uint64_t seed = 5);
Verdict takes_another_course_with_another_seed(const Candidate& candidate, std::uint64_t seed = 5);
Verdict does_not_depend_on_the_order_of_parallel_work(const Candidate& candidate, std::uint64_t seed = 3);

Verdict survives_failed_evaluations(const Candidate& candidate, std::uint64_t seed = 11);
Verdict gives_up_when_nothing_can_be_evaluated(const Candidate& candidate, std::uint64_t seed = 1);
Verdict prints_nothing(const Candidate& candidate, std::uint64_t seed = 1);

Verdict prefers_feasible_points(const Candidate& candidate, std::uint64_t seed = 1);
Verdict reaches_the_boundary_of_what_is_feasible(const Candidate& candidate, std::uint64_t seed = 1);
Verdict is_not_misled_where_costly_tests_are_left_out(const Candidate& candidate, std::uint64_t seed = 1);
Verdict says_so_where_nothing_is_feasible(const Candidate& candidate, std::uint64_t seed = 1);

using OptimizerProperty = PropertyOf<Candidate>;
const std::vector<OptimizerProperty>& optimizer_properties();

}  // namespace tunica::conformance
