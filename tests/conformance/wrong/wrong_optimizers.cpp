// SPDX-License-Identifier: Apache-2.0
// Two random walks: one leaves the box, and the other is not reproducible.
#include <algorithm>
#include <random>

#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

class Walk final : public Optimizer {
 public:
  Walk(bool bounded, bool seeded) : bounded_(bounded), seeded_(seeded) { needs_.random = true; }
  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem& problem) override {
    // A process that searches twice gets two courses; its first is the orderly one, so this is all that is wrong.
    static std::uint64_t searches = 0;
    std::mt19937_64 engine(problem.seed("walk") + (seeded_ ? 0 : searches++));
    std::normal_distribution<double> step;
    std::vector<double> best(problem.start().begin(), problem.start().end()), next = best;
    double least = 0, value = 0, size = 0.3;
    bool any = false;
    std::uint64_t failures = 0;
    while (!problem.should_stop()) {
      for (std::size_t i = 0; i < best.size(); ++i) {
        next[i] = best[i] + (any ? size * step(engine) : 0);
        if (bounded_) next[i] = std::clamp(next[i], 0.0, 1.0);
      }
      if (!problem.evaluate(next, value).ok()) {
        if (++failures > 1000 && !any) return {false, "none of 1000 points could be evaluated"};
        continue;
      }
      if (best.empty()) return {true, "nothing is free"};
      const bool better = !any || value < least;
      size = std::clamp(size * (better ? 1.5 : 0.9), 1e-9, 0.3);
      if (better) {
        any = true;
        least = value;
        best = next;
      }
    }
    return {false, "stopped"};
  }

 private:
  Needs needs_;
  bool bounded_, seeded_;
};

OptimizerFactory walk(const char* type, bool bounded, bool seeded) {
  return {type, "A random walk.", "", {}, [=](const Options&) { return std::make_unique<Walk>(bounded, seeded); }};
}

}  // namespace

TUNICA_PLUGIN("wrong_optimizers", "0.1.0") {
  registry.add(walk("boundless", false, true));
  registry.add(walk("irreproducible", true, false));
  registry.add(walk("orderly", true, true));
}
