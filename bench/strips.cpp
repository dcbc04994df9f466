// SPDX-License-Identifier: Apache-2.0
// Time of one objective evaluation of two strips of 40 points, of its exact Jacobian, and of what the evolution
// strategy and the host add to it.
//
// Peer: the authors' public numba code, 184 µs for the objective. Floor: throw-away prototypes with the baseline
// instruction set, 1.8 µs (objective) and 2.05 µs (with the 5-parameter Jacobian). Both were measured on this kind
// of machine; `speed_up` is peer/time, `of_floor` time/floor.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cmath>

#include "calibration/calibration_problem.hpp"
#include "lamb_aorta.hpp"

namespace tunica::bench {
namespace {

constexpr double peer = 184e-6, floor_objective = 1.8e-6, floor_jacobian = 2.05e-6;

void ratios(benchmark::State& state, double floor_seconds) {
  using benchmark::Counter;
  state.counters["speed_up"] = Counter(peer, Counter::kIsIterationInvariantRate);
  state.counters["of_floor"] =
      Counter(floor_seconds, static_cast<Counter::Flags>(Counter::kIsIterationInvariantRate | Counter::kInvert));
}

/// A walk over the valley, so that every evaluation meets other parameters.
void objective(benchmark::State& state, const char* model, bool jacobian) {
  const calibration::Assembly assembly(lamb_aorta(), run_of(model, "es"), catalogue());
  const auto workspace = assembly.make_workspace();
  const std::size_t n = assembly.parameters().size();
  std::vector<double> x(n), p(n), residuals(jacobian ? assembly.residual_count() : 0),
      J(jacobian ? n * assembly.residual_count() : 0), per_test(2);
  double value = 0;
  std::uint64_t failed = 0, k = 0;
  for (auto _ : state) {
    for (std::size_t j = 0; j < n; ++j) x[j] = 0.25 + 0.1 * static_cast<double>((k * (j + 3)) % 97) / 97;
    ++k;
    assembly.from_unit(x, p);
    failed += !assembly.evaluate(p, value, per_test, residuals, J, *workspace).ok();
    benchmark::DoNotOptimize(value);
  }
  state.counters["failed"] = static_cast<double>(failed);
  ratios(state, jacobian ? floor_jacobian : floor_objective);
}
BENCHMARK_CAPTURE(objective, gho, "gho", false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(objective, gho_with_jacobian, "gho", true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(objective, holzapfel_2015, "holzapfel_2015", false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(objective, holzapfel_2015_with_jacobian, "holzapfel_2015", true)->Unit(benchmark::kMicrosecond);

/// A whole calibration by `es`; the argument is the number of threads. `per_evaluation` is wall time, so on one
/// thread overhead = per_evaluation − the objective's own time, which is measured in the same process.
void evolution_strategy(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  const calibration::Assembly assembly(lamb_aorta(), run_of("gho", "es"), catalogue());
  std::uint64_t evaluations = 0, seed = 0;
  for (auto _ : state) {
    calibration::CalibrationProblem problem(assembly, {.stop = {.max_evaluations = 30000}, .seed = ++seed});
    static_cast<void>(make_optimizer("es")->minimise(problem));
    evaluations += problem.evaluations();
  }
  using benchmark::Counter;
  state.counters["per_evaluation"] =
      Counter(static_cast<double>(evaluations), static_cast<Counter::Flags>(Counter::kIsRate | Counter::kInvert));
  state.counters["evaluations_per_s"] = Counter(static_cast<double>(evaluations), Counter::kIsRate);
}
BENCHMARK(evolution_strategy)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

}  // namespace
}  // namespace tunica::bench

BENCHMARK_MAIN();
