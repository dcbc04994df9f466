// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "calibration/fakes.hpp"
#include "execution/fake_optimizers.hpp"
#include "execution/plan.hpp"

namespace tunica::trial {

/// A complete experiment on the fakes: a parabola with a = 2, b = 1, c = 3 measured without noise by one curve.
class Laboratory {
 public:
  Laboratory() {
    const auto x = fakes::grid(0, 1, 5);
    bench.add_test("curve", x, fakes::map(x, [](double at) { return 2 + at + 3 * at * at; }));
    bench.shelf = fakes::full_catalogue();
    bench.experiment.input_json = "{\"name\": \"fake\", \"stop\": {\"max_evaluations\": 100}}";
    for (const char* type : {"walk", "compass", "residual", "descent", "thrower", "narrow"})
      bench.experiment.optimizers.push_back(fakes::optimizer_entry(type));
  }

  experiment::RunEntry& add_run(const std::string& optimizer, std::uint64_t evaluations = 100,
                                std::uint64_t realisations = 1) {
    auto run = bench.run;
    run.optimizer = optimizer;
    run.realisations = realisations;
    run.stop = {};
    run.stop.max_evaluations = evaluations;
    run.objective = experiment::ObjectiveType::least_squares;
    bench.experiment.runs.push_back(run);
    return bench.experiment.runs.back();
  }
  execution::Plan plan() const { return execution::make_plan(bench.experiment, bench.shelf); }

  fakes::Bench bench;
};

}  // namespace tunica::trial
