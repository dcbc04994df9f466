// SPDX-License-Identifier: Apache-2.0
// Success over seeds on the real lamb aorta: how often each run of the example reaches 66.101 (optimum 66.1000)
// within its own budget from random starts, and after how many evaluations.   bench_success [seeds]
#include <algorithm>
#include <cstdlib>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <fmt/format.h>

#include "lamb_aorta.hpp"
#include "search/calibration_problem.hpp"

int main(int count, char** arguments) {
  using namespace tunica;
  const int seeds = count > 1 ? std::atoi(arguments[1]) : 20;
  constexpr double target = 66.101;
  fmt::print("{:<16}{:<6}{:>9}{:>12}{:>12}{:>12}{:>14}\n", "model", "by", "budget", "success", "median", "largest",
             "worst best");
  for (const experiment::RunEntry& run : bench::lamb_aorta().runs) {
    const assembly::Assembly assembly(bench::lamb_aorta(), run, bench::catalogue());
    std::vector<std::uint64_t> needed;
    double worst = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      experiment::Stop stop = run.stop;
      stop.target = target;
      search::CalibrationProblem::Settings settings;
      settings.stop = stop;
      // A random start a seed: the first start of `lm` would be the same one for all otherwise.
      boost::random::mt19937_64 generator(static_cast<std::uint64_t>(seed));
      boost::random::uniform_real_distribution<double> unit(0, 1);
      for (std::size_t j = 0; j < assembly.layout().parameters.size(); ++j) settings.start.push_back(unit(generator));
      settings.seed = derive_seed(static_cast<std::uint64_t>(seed), "success");
      search::CalibrationProblem problem(assembly, std::move(settings));
      static_cast<void>(bench::make_optimizer(run.optimizer)->minimise(problem));
      if (problem.best().objective <= target) needed.push_back(problem.evaluations());
      worst = std::max(worst, problem.best().objective);
    }
    std::sort(needed.begin(), needed.end());
    const std::string success = fmt::format("{}/{}", needed.size(), seeds);
    fmt::print("{:<16}{:<6}{:>9}{:>12}{:>12}{:>12}{:>14.4f}\n", run.model, run.optimizer, run.stop.max_evaluations,
               success, needed.empty() ? 0 : needed[needed.size() / 2], needed.empty() ? 0 : needed.back(), worst);
  }
}
