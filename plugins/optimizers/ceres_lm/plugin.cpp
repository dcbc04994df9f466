// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

#include <fmt/core.h>
#include <glog/logging.h>

#include "multi_start.hpp"

namespace tunica::ceres_lm {
namespace {

const std::vector<Option> options = {
    Option::integer("starts", 20, {1, 1e6},
                    "Number of starting points; the first is the initial values of the parameters."),
    Option::choice("sampling", {"latin_hypercube", "sobol"}, "latin_hypercube",
                   "How the other starts are spread over the bounds: latin_hypercube, or sobol, a randomly shifted "
                   "Sobol' sequence."),
    Option::integer("max_iterations", 200, {1, 1e6},
                    "Iterations of one descent; five times as many where there are constraints."),
    Option::integer("screening_iterations", 0, {0, 1e6},
                    "Iterations every start gets before only the best are continued; 0 follows every start to its "
                    "end."),
    Option::integer("polished", 5, {1, 1e6}, "Starts that are continued after screening."),
    Option::number("function_tolerance", 1e-10, {0, 1},
                   "A descent ends when a step changes the objective by less than this fraction."),
    Option::number("gradient_tolerance", 1e-10, {0, 1e6},
                   "A descent ends when the projected gradient, with parameters scaled to their ranges, is smaller."),
    Option::number("parameter_tolerance", 1e-9, {0, 1},
                   "A descent ends when a step is shorter than this fraction of the parameters scaled to their "
                   "ranges.")};

std::unique_ptr<Optimizer> create(const Options& given) {
  const std::string& sampling = given.text("sampling");
  if (sampling != "latin_hypercube" && sampling != "sobol") {
    throw InputError(fmt::format("'{}' is not a choice of 'sampling'", sampling));
  }
  return std::make_unique<MultiStart>(
      Settings{.starts = given.count("starts"),
               .sampling = sampling == "sobol" ? Sampling::sobol : Sampling::latin_hypercube,
               .max_iterations = static_cast<int>(given.integer("max_iterations")),
               .screening_iterations = static_cast<int>(given.integer("screening_iterations")),
               .polished = given.count("polished"),
               .function_tolerance = given.number("function_tolerance"),
               .gradient_tolerance = given.number("gradient_tolerance"),
               .parameter_tolerance = given.number("parameter_tolerance")});
}

}  // namespace
}  // namespace tunica::ceres_lm

TUNICA_PLUGIN("ceres_lm", "0.1.0") {
  // Ceres logs a start it could not evaluate to stderr although asked to be silent; here that is a status.
  FLAGS_minloglevel = google::GLOG_FATAL;
  registry.add(tunica::OptimizerFactory{
      .type = "ceres_lm",
      .doc = "Bounded Levenberg-Marquardt with exact Jacobians from many starts, for least squares and sums of norms; "
             "fast where the objective is smooth.",
      .reference = "D. W. Marquardt, J. SIAM 11 (1963) 431-441; K. Madsen, H. B. Nielsen, O. Tingleff, Methods for "
                   "Non-Linear Least Squares Problems, 2nd ed., DTU (2004); "
                   "S. Agarwal, K. Mierle et al., Ceres Solver 2.1, ceres-solver.org.",
      .options = tunica::ceres_lm::options,
      .create = tunica::ceres_lm::create,
      .refines = true});
}
