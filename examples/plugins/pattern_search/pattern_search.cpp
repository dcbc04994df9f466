// SPDX-License-Identifier: Apache-2.0
// Compass search (Kolda, Lewis, Torczon 2003, SIAM Review 45:385–482, algorithm 1): try a step along every axis, both
// ways; go where it is best, and halve the step where none is better. Without derivatives, without random numbers; a
// first search from the given point, the others from points spread over the box.
#include <cmath>

#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

/// What a point is worth: feasible before infeasible, then the smaller objective or violation; failed is the worst.
struct Worth {
  int rank = 2;
  double value = 0;
  Worth() = default;
  Worth(const Status& status, double objective) {
    if (status.kind() == Status::Kind::ok) rank = 0, value = objective;
    if (status.kind() == Status::Kind::infeasible) rank = 1, value = status.violation();
  }
  bool operator<(const Worth& other) const { return rank != other.rank ? rank < other.rank : value < other.value; }
};

class PatternSearchOptimizer final : public Optimizer {
 public:
  explicit PatternSearchOptimizer(const Options& options)
      : starts_(static_cast<std::size_t>(options.integer("starts"))),
        first_step_(options.number("initial_step")),
        last_step_(options.number("step_tolerance")) {}
  [[nodiscard]] const Needs& needs() const override { return needs_; }

  Outcome minimise(Problem& problem) override {
    const std::size_t n = problem.dimension();
    Worth best;
    std::string last_failure;
    for (std::size_t k = 0; k < starts_ && !problem.should_stop(); ++k) {
      std::vector<double> x(problem.start().begin(), problem.start().end());
      // Later starts on a lattice of irrational slopes (Kronecker), √2, √3, √5 …, which fills the box evenly.
      for (std::size_t j = 0; k > 0 && j < n; ++j) x[j] = std::fmod(static_cast<double>(k) * irrational(j), 1.0);
      const Worth found = descend(problem, std::move(x), last_failure);
      if (found < best) best = found;
    }
    if (best.rank == 2)
      return {false,
              last_failure.empty() ? "stopped" : "no point could be evaluated, the last because: " + last_failure};
    if (best.rank == 1)
      return {false, problem.should_stop() ? "stopped; no feasible point was found" : "no feasible point was found"};
    if (problem.should_stop()) return {false, "stopped"};
    return {true, "steps below " + std::to_string(last_step_) + " of the box from every start"};
  }

 private:
  static double irrational(std::size_t j) {
    static constexpr std::array<double, 12> primes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
    return std::sqrt(primes[j % primes.size()] + static_cast<double>(j / primes.size()));
  }

  Worth descend(Problem& problem, std::vector<double> x, std::string& last_failure) const {
    const std::size_t n = x.size();
    double objective = 0;
    const Status first = problem.evaluate(x, objective);
    if (first.kind() == Status::Kind::failed) last_failure = first.reason();
    Worth here(first, objective);
    std::vector<double> around(2 * n * n), objectives(2 * n);
    std::vector<Status> statuses(2 * n);
    for (double step = first_step_; step > last_step_ && !problem.should_stop();) {
      for (std::size_t k = 0; k < 2 * n; ++k) {
        std::copy(x.begin(), x.end(), around.begin() + static_cast<std::ptrdiff_t>(k * n));
        double& moved = around[k * n + k / 2];
        moved = std::clamp(moved + (k % 2 == 0 ? step : -step), 0.0, 1.0);
      }
      problem.evaluate_batch(around, objectives, statuses);
      std::size_t best = 2 * n;
      Worth found = here;
      for (std::size_t k = 0; k < 2 * n; ++k) {
        if (statuses[k].kind() == Status::Kind::failed) last_failure = statuses[k].reason();
        if (const Worth it(statuses[k], objectives[k]); it < found) found = it, best = k;
      }
      if (best == 2 * n) {
        step /= 2;
      } else {
        here = found;
        x.assign(around.begin() + static_cast<std::ptrdiff_t>(best * n),
                 around.begin() + static_cast<std::ptrdiff_t>((best + 1) * n));
      }
    }
    return here;
  }

  std::size_t starts_;
  double first_step_, last_step_;
  Needs needs_{.constraints = true, .batch = true};
};

}  // namespace

TUNICA_PLUGIN("pattern_search", "1.0.0") {
  using Kind = Option::Kind;
  registry.add(
      OptimizerFactory{"pattern_search",
                       "Compass search: a step along every axis, halved where none is better.",
                       "Kolda, Lewis, Torczon, SIAM Review 45:385 (2003)",
                       {{.name = "starts",
                         .kind = Kind::integer,
                         .fallback = std::int64_t{4},
                         .doc = "Searches, the first from the "
                                "initial values.",
                         .min = 1,
                         .max = 1e6},
                        {.name = "initial_step",
                         .kind = Kind::number,
                         .fallback = 0.25,
                         .doc = "First step, as a part of the range of "
                                "each parameter.",
                         .min = 1e-6,
                         .max = 1},
                        {.name = "step_tolerance",
                         .kind = Kind::number,
                         .fallback = 1e-6,
                         .doc = "A search ends at steps below this "
                                "part of the range.",
                         .min = 1e-15,
                         .max = 0.1}},
                       [](const Options& options) { return std::make_unique<PatternSearchOptimizer>(options); }});
}
