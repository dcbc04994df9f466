// SPDX-License-Identifier: Apache-2.0
// Optimisers on functions with known optima, over seeds: first without constraints, success to 1e-8 and evaluations;
// then with active constraints against published figures. ISRES as its authors report it (Runarsson & Yao 2005,
// 350 000 evaluations, 100 runs): g04 −30665.539, g06 −6961.814, g07 24.306, g09 680.630, g10 7049.248, median and
// worst alike but for 7049.270.   bench_optimizers [seeds] [evaluations] [evaluations with constraints]
#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "conformance/functions.hpp"
#include "conformance/g_suite.hpp"
#include "plugins.hpp"

namespace {

using namespace tunica::bench;
using namespace tunica::conformance;

struct Method {
  const char* name;
  std::string type;
  OptionValues given;
};

void without_constraints(int seeds, std::uint64_t budget) {
  const std::vector<Method> methods = {
      {"es", "es", {}},
      {"es comma", "es", {{"selection", "comma"}}},
      {"es self-adaptive", "es", {{"step_control", "self_adaptive"}}},
      {"es axes", "es", {{"adaptation", "axes"}}},
      {"es isotropic", "es", {{"adaptation", "isotropic"}}},
      {"cma_es", "cma_es", {}},
#ifdef TUNICA_HAVE_PAGMO
      {"pagmo_cmaes", "pagmo_cmaes", {}},
      {"pagmo_de", "pagmo_de", {}},
      {"pagmo_pso", "pagmo_pso", {}},
      {"pagmo_ga", "pagmo_ga", {}},
#endif
      {"nlopt crs2_lm", "nlopt", {{"algorithm", "crs2_lm"}}},
      {"nlopt isres", "nlopt", {{"algorithm", "isres"}}},
      {"nlopt direct_l", "nlopt", {{"algorithm", "direct_l"}}},
      {"nlopt mlsl", "nlopt", {{"algorithm", "mlsl"}}},
      {"nlopt cobyla", "nlopt", {{"algorithm", "cobyla"}}},
      {"nlopt bobyqa", "nlopt", {{"algorithm", "bobyqa"}}},
      {"nlopt slsqp", "nlopt", {{"algorithm", "slsqp"}}},
      {"ceres_lm", "ceres_lm", {}},
  };
  const std::vector<Function> functions = {sphere(6), ellipsoid(6), rosenbrock(6), rastrigin(6)};
  fmt::print("{:<18}", "");
  for (const Function& function : functions) fmt::print("{:>22}", function.name);
  fmt::print("\n");
  for (const Method& method : methods) {
    fmt::print("{:<18}", method.name);
    for (const Function& function : functions) {
      std::vector<std::uint64_t> needed;
      for (int seed = 1; seed <= seeds; ++seed) {
        FunctionProblem problem(
            function, {.budget = budget, .seed = static_cast<std::uint64_t>(seed), .target = function.optimum + 1e-8});
        static_cast<void>(make_optimizer(method.type, method.given)->minimise(problem));
        if (problem.best <= function.optimum + 1e-8) needed.push_back(problem.evaluations());
      }
      std::sort(needed.begin(), needed.end());
      fmt::print("{:>22}", needed.empty() ? fmt::format("0/{}", seeds)
                                          : fmt::format("{}/{} ({})", needed.size(), seeds, needed[needed.size() / 2]));
    }
    fmt::print("\n");
  }
}

void with_constraints(int seeds, std::uint64_t budget) {
  const std::vector<Method> methods = {
      {"nlopt isres", "nlopt", {{"algorithm", "isres"}}},
      {"nlopt crs2_lm", "nlopt", {{"algorithm", "crs2_lm"}}},
      {"es", "es", {}},
      {"es penalty", "es", {{"infeasible", "constant_penalty"}}},
      {"cma_es", "cma_es", {}},
#ifdef TUNICA_HAVE_PAGMO
      {"pagmo_de", "pagmo_de", {}},
#endif
  };
  fmt::print("\n{:<6}{:<16}{:>10}{:>16}{:>16}{:>16}{:>16}\n", "", "", "feasible", "optimum", "best", "median", "worst");
  for (const GProblem& g : g_suite()) {
    for (const Method& method : methods) {
      std::vector<double> reached;
      for (int seed = 1; seed <= seeds; ++seed) {
        FunctionProblem problem(g_function(g), {.budget = budget, .seed = static_cast<std::uint64_t>(seed)});
        static_cast<void>(make_optimizer(method.type, method.given)->minimise(problem));
        if (!problem.best_point.empty()) reached.push_back(problem.best - g.offset);
      }
      std::sort(reached.begin(), reached.end());
      fmt::print("{:<6}{:<16}{:>7}/{}", g.name, method.name, reached.size(), seeds);
      if (!reached.empty())
        fmt::print("{:>16.4f}{:>16.4f}{:>16.4f}{:>16.4f}", g.optimum, reached.front(), reached[reached.size() / 2],
                   reached.back());
      fmt::print("\n");
    }
  }
}

}  // namespace

int main(int count, char** arguments) {
  const int seeds = count > 1 ? std::atoi(arguments[1]) : 20;
  without_constraints(seeds, count > 2 ? std::strtoull(arguments[2], nullptr, 10) : 30000);
  with_constraints(seeds, count > 3 ? std::strtoull(arguments[3], nullptr, 10) : 350000);
}
