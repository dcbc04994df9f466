// SPDX-License-Identifier: Apache-2.0
// How an optimiser behaves: the same on every run, and sensibly where things go wrong.
#include <fmt/format.h>

#include "conformance/captured_output.hpp"
#include "conformance/searches.hpp"

namespace tunica::conformance {
namespace {

/// "evaluation 17, parameter 2: 0.5 and 0.25": where two courses part.
std::string parting(const std::vector<double>& a, const std::vector<double>& b, std::size_t n) {
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (a[i] != b[i])
      return fmt::format("evaluation {}, parameter {}: {:.17g} and {:.17g}", i / n + 1, i % n + 1, a[i], b[i]);
  return fmt::format("{} and {} evaluations", a.size() / n, b.size() / n);
}

struct Course {
  FunctionProblem problem;
  Optimizer::Outcome outcome;
  Course(const Candidate& candidate, Function function, FunctionProblem::Settings settings)
      : problem(std::move(function), settings), outcome(search(candidate, problem)) {}
};

}  // namespace

Verdict repeats_itself_with_the_same_seed(const Candidate& candidate, std::uint64_t seed) {
  const std::string compared = "two searches with the same seed, bit for bit";
  const std::size_t n = std::max<std::size_t>(2, dimensions(candidate, 3));
  const Course first(candidate, rosenbrock(n), {.budget = 2000, .seed = seed, .remember = true});
  const Course second(candidate, rosenbrock(n), {.budget = 2000, .seed = seed, .remember = true});
  if (first.problem.asked != second.problem.asked)
    return broken(compared, "they part at " + parting(first.problem.asked, second.problem.asked, n));
  if (first.outcome.reason != second.outcome.reason)
    return broken(compared,
                  fmt::format("one ends with '{}', the other with '{}'", first.outcome.reason, second.outcome.reason));
  return {.compared = compared};
}

Verdict takes_another_course_with_another_seed(const Candidate& candidate, std::uint64_t seed) {
  const std::string compared = "two searches with different seeds";
  if (!candidate.make()->needs().random) return not_checked(compared, "it declares that nothing depends on the seed");
  const std::size_t n = std::max<std::size_t>(2, dimensions(candidate, 3));
  const Course first(candidate, rosenbrock(n), {.budget = 20000, .seed = seed, .remember = true});
  const Course second(candidate, rosenbrock(n), {.budget = 20000, .seed = seed + 1, .remember = true});
  if (first.problem.asked == second.problem.asked)
    return broken(compared, "they are the same, though random is declared: use Problem::seed()");
  return {.compared = compared};
}

Verdict does_not_depend_on_the_order_of_parallel_work(const Candidate& candidate, std::uint64_t seed) {
  const std::string compared = "searches of which batches and starts are worked through forwards and backwards";
  const std::size_t n = dimensions(candidate, 3);
  const Course forwards(candidate, rastrigin(n), {.budget = 20000, .seed = seed});
  const Course backwards(candidate, rastrigin(n), {.budget = 20000, .seed = seed, .reverse = true});
  // Of two points with the same objective, either is the best one.
  if (forwards.problem.best_point != backwards.problem.best_point && forwards.problem.best != backwards.problem.best)
    return broken(compared,
                  "the best points differ in " + parting(forwards.problem.best_point, backwards.problem.best_point, n));
  if (forwards.problem.evaluations() != backwards.problem.evaluations())
    return broken(compared, fmt::format("they make {} and {} evaluations", forwards.problem.evaluations(),
                                        backwards.problem.evaluations()));
  if (forwards.outcome.reason != backwards.outcome.reason)
    return broken(compared, fmt::format("one ends with '{}', the other with '{}'", forwards.outcome.reason,
                                        backwards.outcome.reason));
  return {.compared = compared};
}

Verdict survives_failed_evaluations(const Candidate& candidate, std::uint64_t seed) {
  // Which points fail is a hash of their bits and the seed.
  Meter meter("the least objective with the optimum, 0, where three in ten evaluations fail", 1e-2);
  FunctionProblem problem(sphere(dimensions(candidate, 3)),
                          {.budget = candidate.budget, .seed = seed, .failure_rate = 0.3});
  const auto outcome = search(candidate, problem);
  meter.see(problem.best, [&] {
    return fmt::format("{:.3g} is the best of {} evaluations, {} of them failed{}", problem.best, problem.evaluations(),
                       problem.failures, ended(outcome));
  });
  return meter.verdict();
}

Verdict gives_up_when_nothing_can_be_evaluated(const Candidate& candidate, std::uint64_t) {
  const std::string compared = "the outcome where every evaluation fails with: not converged, soon";
  FunctionProblem problem(sphere(dimensions(candidate, 3)), {.budget = 1000000, .failure_rate = 2});
  const auto outcome = search(candidate, problem);
  if (outcome.converged) return broken(compared, "it calls that converged" + ended(outcome));
  if (problem.evaluations() >= 100000)
    return broken(compared, fmt::format("it goes on for {} evaluations; give up and say why", problem.evaluations()));
  if (outcome.reason.empty()) return broken(compared, "the outcome has no reason");
  return {.compared = compared};
}

Verdict prints_nothing(const Candidate& candidate, std::uint64_t) {
  const std::string compared = "what a search writes to stdout and stderr with nothing";
  CapturedOutput output;
  for (const double failures : {0., 2.}) {
    FunctionProblem problem(sphere(dimensions(candidate, 3)), {.budget = 5000, .failure_rate = failures});
    search(candidate, problem);
  }
  const std::string text = output.text();
  if (!text.empty()) return broken(compared, fmt::format("it prints '{}'", text.substr(0, text.find('\n'))));
  return {.compared = compared};
}

}  // namespace tunica::conformance
