// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "nlopt_optimizer.hpp"

namespace tunica::nlopt_plugin {
namespace {

using Kind = Option::Kind;

const std::vector<Option> options = {
    {.name = "algorithm",
     .kind = Kind::choice,
     .fallback = "crs2_lm",
     .doc = "Global: crs2_lm (controlled random search), isres (evolution strategy with stochastic ranking), direct_l "
            "(dividing rectangles), mlsl (many local searches). Local, from many starts: cobyla and bobyqa (no "
            "derivatives), slsqp (gradient).",
     .choices = {"crs2_lm", "isres", "direct_l", "mlsl", "cobyla", "bobyqa", "slsqp"}},
    {.name = "local_algorithm",
     .kind = Kind::choice,
     .fallback = "slsqp",
     .doc = "The local algorithm of mlsl.",
     .choices = {"cobyla", "bobyqa", "slsqp"}},
    {.name = "starts",
     .kind = Kind::integer,
     .fallback = std::int64_t{20},
     .doc = "Number of starting points of a local algorithm; the first is the initial values of the parameters.",
     .min = 1,
     .max = 1e6},
    {.name = "restarts",
     .kind = Kind::integer,
     .fallback = std::int64_t{10},
     .doc = "Further searches of crs2_lm and isres, with other random numbers, after one made no more progress.",
     .min = 0,
     .max = 1e6},
    {.name = "population",
     .kind = Kind::integer,
     .fallback = std::int64_t{0},
     .doc = "Points that crs2_lm, isres and mlsl keep; 0 leaves it to NLopt: 10 (n + 1), 20 (n + 1), 4.",
     .min = 0,
     .max = 1e6},
    {.name = "initial_step",
     .kind = Kind::number,
     .fallback = 0.1,
     .doc = "First step of cobyla and bobyqa, as a fraction of the range of each parameter.",
     .min = 1e-6,
     .max = 0.5},
    {.name = "stall",
     .kind = Kind::integer,
     .fallback = std::int64_t{0},
     .doc = "Evaluations without progress after which a global search ends; 0 means 200 (n + 1), for isres "
            "2000 (n + 1).",
     .min = 0,
     .max = 1e9},
    {.name = "tolerance",
     .kind = Kind::number,
     .fallback = 1e-10,
     .doc = "Relative improvement of the objective that counts as progress; a local search ends below it.",
     .min = 0,
     .max = 1},
    {.name = "step_tolerance",
     .kind = Kind::number,
     .fallback = 1e-9,
     .doc = "A local search ends when its steps are shorter than this fraction of the ranges.",
     .min = 0,
     .max = 1},
};

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
                          .starts = static_cast<std::size_t>(given.integer("starts")),
                          .restarts = static_cast<std::size_t>(given.integer("restarts")),
                          .population = static_cast<std::size_t>(given.integer("population")),
                          .initial_step = given.number("initial_step"),
                          .stall = static_cast<std::size_t>(given.integer("stall")),
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
