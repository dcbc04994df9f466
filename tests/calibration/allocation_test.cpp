// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "calibration/count_allocations.hpp"
#include "calibration/fakes.hpp"

namespace tunica {
namespace {

using fakes::allocations_in;

/// Two strips of 40 rows, as in the calibration of an artery.
class HotPath : public testing::TestWithParam<bool> {
 protected:
  HotPath() {
    if (GetParam()) bench_.model().mechanisms = {{"memory", {}, {}}};  // differences instead of derivatives
    for (const char* name : {"s", "t"}) {
      const std::vector<double> x = fakes::grid(0, 2, 40);
      bench_.add_test(name, x, fakes::map(x, [](double v) { return 1 + v; })).mechanisms = {{"offset", {}, {}}};
    }
    bench_.run.objective = experiment::ObjectiveType::sum_of_norms;
  }
  fakes::Bench bench_;
};

TEST_P(HotPath, AllocatesNothingInTheAssemblyAfterTheFirstCalls) {
  const assembly::Assembly assembly = bench_.assemble();
  const std::size_t n = assembly.layout().parameters.size();
  std::vector<double> free, predictions(assembly.layout().prediction_count), by_prediction(predictions.size() * n);
  for (const auto& parameter : assembly.layout().parameters) free.push_back(parameter.initial);
  std::vector<double> per_test(2), residuals(assembly.layout().residual_count), by_residual(residuals.size() * n);
  const auto workspace = assembly.evaluator().make_workspace();
  double objective = 0;
  EXPECT_GT(allocations_in([&] { free.reserve(1000); }), 0) << "the counter counts";
  const auto calls = [&] {
    for (int k = 0; k < 10; ++k) {
      static_cast<void>(assembly.evaluator().predict(free, predictions, by_prediction, *workspace));
      static_cast<void>(assembly.evaluator().evaluate(free, objective, per_test, {}, {}, *workspace));
      static_cast<void>(assembly.evaluator().evaluate(free, objective, per_test, residuals, by_residual, *workspace));
    }
  };
  calls();  // the guard of a model makes the first one of each kind between fences
  EXPECT_EQ(allocations_in(calls), 0);
}

TEST_P(HotPath, AllocatesNothingInTheProblemAfterTheFirstCalls) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);  // the scheduler's own do not count
  const assembly::Assembly assembly = bench_.assemble();
  search::CalibrationProblem problem(assembly, {});
  const std::size_t n = problem.dimension();
  std::vector<double> xs(30 * n, 0.5), objectives(30), residuals(problem.residual_count()),
      jacobian(residuals.size() * n);
  std::vector<Status> statuses(30);
  double objective = 0;
  const auto calls = [&] {
    problem.evaluate_batch(xs, objectives, statuses);
    static_cast<void>(problem.evaluate(std::span(xs).first(n), objective));
    static_cast<void>(problem.linearise(std::span(xs).first(n), objective, residuals, jacobian));
  };
  calls();
  EXPECT_EQ(allocations_in(calls), 0);
}

INSTANTIATE_TEST_SUITE_P(Models, HotPath, testing::Bool(),
                         [](const auto& differenced) { return differenced.param ? "Differenced" : "Exact"; });

}  // namespace
}  // namespace tunica
