// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tbb/task_arena.h>

#include "calibration/fakes.hpp"
#include "support/loaded.hpp"
#include "uncertainty/refit.hpp"

namespace tunica::trial {

/// ceres_lm from where it is told to start.
inline uncertainty::LocalOptimizer local() {
  const auto& entry = testing::catalogue().optimizers().at("ceres_lm");
  Options options = testing::defaults(entry.factory.options);
  options.set("starts", std::int64_t{1});
  return {&entry, std::move(options)};
}

/// y = 1 + 2x + e at n places from 0 to 7, c held at 0: a linear problem in a (linear scale) and b (log scale).
struct Line : fakes::Bench {
  explicit Line(std::size_t n = 8)
      : Line(fakes::grid(0, 7, n), [](std::size_t i) { return i % 4 == 0 || i % 4 == 3 ? 0.1 : -0.1; }) {}
  Line(std::vector<double> places, const std::function<double(std::size_t)>& error) : x(std::move(places)) {
    parameter("c").fixed = 0;
    for (std::size_t i = 0; i < x.size(); ++i) y.push_back(1 + 2 * x[i] + error(i));
    add_test("t", x, y);
    run.objective = experiment::ObjectiveType::least_squares;
  }
  std::vector<double> x, y;
};

/// The same computed by one thread and by two.
template <class Call>
auto by_threads(int threads, Call&& call) {
  tbb::task_arena arena(threads);
  return arena.execute(call);
}

}  // namespace tunica::trial
