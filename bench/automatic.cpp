// SPDX-License-Identifier: Apache-2.0
// What an energy costs whose derivatives are all automatic, beside gho whose law is differentiated by hand: objective
// and Jacobian of two strips of 40 points. `of_gho` is time/time of gho in the same run; asked for are 4 at most.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "assembly/assembly.hpp"
#include "experiment/experiment.hpp"
#include "plugins/loader.hpp"

namespace {

using namespace tunica;

/// Seconds of one evaluation at points around the optimum, the median of 15 rounds; `value` is the sum of objectives.
double time_of(const assembly::Assembly& assembly, bool jacobian, double& value) {
  const auto workspace = assembly.evaluator().make_workspace();
  const std::size_t n = assembly.layout().parameters.size();
  std::vector<double> residuals(jacobian ? assembly.layout().residual_count : 0),
      J(jacobian ? n * residuals.size() : 0), per_test(2), rounds;
  for (int round = 0; round < 15; ++round) {
    constexpr int calls = 4000;
    value = 0;
    const auto begin = std::chrono::steady_clock::now();
    for (int k = 0; k < calls; ++k) {
      const double shift = 1 + 1e-4 * (k % 97);
      const std::vector<double> p{22.386 * shift, 0.20334, 15.097 * shift, 0.036, 57.17};
      double objective = 0;
      static_cast<void>(assembly.evaluator().evaluate(p, objective, per_test, residuals, J, *workspace));
      value += objective;
    }
    rounds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / calls);
  }
  std::nth_element(rounds.begin(), rounds.begin() + 7, rounds.end());
  return rounds[7];
}

}  // namespace

int main() {
  plugins::Catalogue catalogue;
  static_cast<void>(plugins::load_all({{TUNICA_PLUGIN_DIR, TUNICA_AUTOMATIC_DIR}, true}, catalogue));
  const auto experiment =
      experiment::read_experiment(TUNICA_SOURCE_DIR "/bench/automatic_gho/experiment.json", catalogue);
  for (const bool jacobian : {false, true}) {
    double reference = 0, expected = 0;
    for (const experiment::RunEntry& run : experiment.runs) {
      const assembly::Assembly assembly(experiment, run, catalogue);
      double value = 0;
      const double seconds = time_of(assembly, jacobian, value);
      if (run.model == "gho") {
        reference = seconds;
        expected = value;
      }
      fmt::print("{:<12} {:<22} {:>7.2f} us   of_gho {:.2f}   sum differs by {:.1e}\n", run.model,
                 jacobian ? "objective and Jacobian" : "objective", seconds * 1e6, seconds / reference,
                 std::abs(value / expected - 1));
    }
  }
}
