// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "nlopt_optimizer.hpp"

namespace tunica::nlopt_plugin {
namespace {

const std::vector<Option> options = {
    Option::choice("algorithm", {"crs2_lm", "isres", "direct_l", "mlsl", "cobyla", "bobyqa", "slsqp"}, "crs2_lm",
                   "Global: crs2_lm (controlled random search), isres (evolution strategy with stochastic ranking), "
                   "direct_l (dividing rectangles), mlsl (many local searches). Local, from many starts: cobyla and "
                   "bobyqa (no derivatives), slsqp (gradient)."),
    Option::choice("local_algorithm", {"cobyla", "bobyqa", "slsqp"}, "slsqp", "The local algorithm of mlsl."),
    Option::integer("starts", 20, {1, 1e6},
                    "Number of starting points of a local algorithm; the first is the initial values of the "
                    "parameters."),
    Option::integer("restarts", 10, {0, 1e6},
                    "Further searches of crs2_lm and isres, with other random numbers, after one made no more "
                    "progress."),
    Option::integer("population", 0, {0, 1e6},
                    "Points that crs2_lm, isres and mlsl keep; 0 leaves it to NLopt: 10 (n + 1), 20 (n + 1), 4."),
    Option::number("initial_step", 0.1, {1e-6, 0.5},
                   "First step of cobyla and bobyqa, as a fraction of the range of each parameter."),
    Option::integer("stall", 0, {0, 1e9},
                    "Evaluations without progress after which a global search ends; 0 means 200 (n + 1), for isres "
                    "2000 (n + 1)."),
    Option::number("tolerance", 1e-10, {0, 1},
                   "Relative improvement of the objective that counts as progress; a local search ends below it."),
    Option::number("step_tolerance", 1e-9, {0, 1},
                   "A local search ends when its steps are shorter than this fraction of the ranges.")};

Algorithm chosen(const Options& given, const std::string& name) {
  // The first option lists the names in the order of the enumerators.
  const auto& choices = options[0].choices;
  const auto found = std::ranges::find(choices, given.text(name));
  if (found == choices.end()) throw InputError(fmt::format("'{}' is not a choice of '{}'", given.text(name), name));
  return static_cast<Algorithm>(found - choices.begin());
}

std::unique_ptr<Optimizer> create(const Options& given) {
  const Settings settings{.algorithm = chosen(given, "algorithm"),
                          .local = chosen(given, "local_algorithm"),
                          .starts = given.count("starts"),
                          .restarts = given.count("restarts"),
                          .population = given.count("population"),
                          .initial_step = given.number("initial_step"),
                          .stall = given.count("stall"),
                          .tolerance = given.number("tolerance"),
                          .step_tolerance = given.number("step_tolerance")};
  return std::make_unique<NloptOptimizer>(settings);
}

}  // namespace
}  // namespace tunica::nlopt_plugin

TUNICA_PLUGIN("nlopt", "0.1.0") {
  registry.add(tunica::OptimizerFactory{
      .type = "nlopt",
      .doc = "Algorithms of NLopt: global and local, with and without derivatives, some with native constraints.",
      .reference = "S. G. Johnson, The NLopt nonlinear-optimization package, github.com/stevengj/nlopt; "
                   "CRS2: P. Kaelo, M. M. Ali, J. Optim. Theory Appl. 130 (2006) 253-264; "
                   "ISRES: T. P. Runarsson, X. Yao, IEEE Trans. Syst. Man Cybern. C 35 (2005) 233-243; "
                   "DIRECT-L: J. M. Gablonsky, C. T. Kelley, J. Global Optim. 21 (2001) 27-37; "
                   "MLSL: S. Kucherenko, Y. Sytsko, Comput. Optim. Appl. 30 (2005) 297-318; "
                   "COBYLA, BOBYQA: M. J. D. Powell (1994, 2009); "
                   "SLSQP: D. Kraft, ACM Trans. Math. Softw. 20 (1994) 262-281.",
      .options = tunica::nlopt_plugin::options,
      .create = tunica::nlopt_plugin::create});
}
