// SPDX-License-Identifier: Apache-2.0
// Compass search (Kolda, Lewis, Torczon 2003, SIAM Review 45:385–482, algorithm 1): try a step along every axis, both
// ways; go where it is best, and halve the step where none is better. Without derivatives, without random numbers; a
// first search from the given point, the others from points spread over the box.
#include <cmath>

#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

class PatternSearchOptimizer final : public Optimizer {
 public:
  explicit PatternSearchOptimizer(const Options& options)
      : starts_(options.count("starts")),
        first_step_(options.number("initial_step")),
        last_step_(options.number("step_tolerance")) {}
  [[nodiscard]] const Needs& needs() const override { return needs_; }

  Outcome minimise(Problem& problem) override {
    const std::size_t n = problem.dimension();
    bool found = false;
    std::string last_failure;
    for (std::size_t k = 0; k < (n == 0 ? 1 : starts_) && !problem.should_stop(); ++k) {
      std::vector<double> x(problem.start().begin(), problem.start().end());
      // Later starts on a lattice of irrational slopes (Kronecker), √2, √3, √5 …, which fills the box evenly.
      for (std::size_t j = 0; k > 0 && j < n; ++j) x[j] = std::fmod(static_cast<double>(k) * irrational(j), 1.0);
      found = descend(problem, std::move(x), last_failure) || found;
    }
    if (!found && !last_failure.empty())
      return {false, "no point could be evaluated, the last because: " + last_failure};
    if (problem.should_stop()) return {false, "stopped"};
    return {found, "steps below " + std::to_string(last_step_) + " of the box from every start"};
  }

 private:
  static double irrational(std::size_t j) {
    static constexpr std::array<double, 12> primes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
    return std::sqrt(primes[j % primes.size()] + static_cast<double>(j / primes.size()));
  }

  /// One search; whether any of its points could be evaluated. A point that could not is as bad as infinity.
  bool descend(Problem& problem, std::vector<double> x, std::string& last_failure) const {
    const std::size_t n = x.size();
    double here = 0;
    if (const Status status = problem.evaluate(x, here); !status.ok()) {
      here = std::numeric_limits<double>::infinity();
      last_failure = status.reason();
    }
    std::vector<double> around(2 * n * n), objectives(2 * n);
    std::vector<Status> statuses(2 * n);
    for (double step = n == 0 ? 0 : first_step_; step > last_step_ && !problem.should_stop();) {
      for (std::size_t k = 0; k < 2 * n; ++k) {
        std::copy(x.begin(), x.end(), around.begin() + static_cast<std::ptrdiff_t>(k * n));
        double& moved = around[k * n + k / 2];
        moved = std::clamp(moved + (k % 2 == 0 ? step : -step), 0.0, 1.0);
      }
      const std::size_t count = std::min<std::uint64_t>(2 * n, problem.budget());
      problem.evaluate_batch({around.data(), count * n}, {objectives.data(), count}, {statuses.data(), count});
      std::size_t best = count;
      for (std::size_t k = 0; k < count; ++k) {
        if (!statuses[k].ok()) last_failure = statuses[k].reason();
        if (statuses[k].ok() && objectives[k] < here) {
          here = objectives[k];
          best = k;
        }
      }
      if (best == count) {
        step /= 2;
      } else {
        x.assign(around.begin() + static_cast<std::ptrdiff_t>(best * n),
                 around.begin() + static_cast<std::ptrdiff_t>((best + 1) * n));
      }
    }
    return std::isfinite(here);
  }

  std::size_t starts_;
  double first_step_, last_step_;
  Needs needs_{.batch = true};  // no constraints: along oblique ones it would stand still
};

}  // namespace

TUNICA_PLUGIN("pattern_search", "1.0.0") {
  registry.add(OptimizerFactory{
      "pattern_search",
      "Compass search: a step along every axis, halved where none is better.",
      "Kolda, Lewis, Torczon, SIAM Review 45:385 (2003)",
      {Option::integer("starts", 4, {1, 1e6}, "Searches, the first from the initial values."),
       Option::number("initial_step", 0.25, {1e-6, 1}, "First step, as a part of the range of each parameter."),
       Option::number("step_tolerance", 1e-6, {1e-15, 0.1}, "A search ends at steps below this part of the range.")},
      [](const Options& options) { return std::make_unique<PatternSearchOptimizer>(options); }});
}
