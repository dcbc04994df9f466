// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

#include <fmt/core.h>
#include <glog/logging.h>

#include "multi_start.hpp"

namespace tunica::ceres_lm {
namespace {

using Kind = Option::Kind;

const std::vector<Option> options = {
    {.name = "starts",
     .kind = Kind::integer,
     .fallback = std::int64_t{20},
     .doc = "Number of starting points; the first is the initial values of the parameters.",
     .min = 1,
     .max = 1e6},
    {.name = "sampling",
     .kind = Kind::choice,
     .fallback = "latin_hypercube",
     .doc = "How the other starts are spread over the bounds: latin_hypercube, or sobol, a randomly shifted Sobol' "
            "sequence.",
     .choices = {"latin_hypercube", "sobol"}},
    {.name = "max_iterations",
     .kind = Kind::integer,
     .fallback = std::int64_t{200},
     .doc = "Iterations of one descent; five times as many where there are constraints.",
     .min = 1,
     .max = 1e6},
    {.name = "screening_iterations",
     .kind = Kind::integer,
     .fallback = std::int64_t{0},
     .doc = "Iterations every start gets before only the best are continued; 0 follows every start to its end.",
     .min = 0,
     .max = 1e6},
    {.name = "polished",
     .kind = Kind::integer,
     .fallback = std::int64_t{5},
     .doc = "Starts that are continued after screening.",
     .min = 1,
     .max = 1e6},
    {.name = "function_tolerance",
     .kind = Kind::number,
     .fallback = 1e-10,
     .doc = "A descent ends when a step changes the objective by less than this fraction.",
     .min = 0,
     .max = 1},
    {.name = "gradient_tolerance",
     .kind = Kind::number,
     .fallback = 1e-10,
     .doc = "A descent ends when the projected gradient, with parameters scaled to their ranges, is smaller.",
     .min = 0,
     .max = 1e6},
    {.name = "parameter_tolerance",
     .kind = Kind::number,
     .fallback = 1e-9,
     .doc = "A descent ends when a step is shorter than this fraction of the parameters scaled to their ranges.",
     .min = 0,
     .max = 1},
};

std::unique_ptr<Optimizer> create(const Options& given) {
  const std::string& sampling = given.text("sampling");
  if (sampling != "latin_hypercube" && sampling != "sobol") {
    throw InputError(fmt::format("'{}' is not a choice of 'sampling'", sampling));
  }
  return std::make_unique<MultiStart>(
      Settings{.starts = static_cast<std::size_t>(given.integer("starts")),
               .sampling = sampling == "sobol" ? Sampling::sobol : Sampling::latin_hypercube,
               .max_iterations = static_cast<int>(given.integer("max_iterations")),
               .screening_iterations = static_cast<int>(given.integer("screening_iterations")),
               .polished = static_cast<std::size_t>(given.integer("polished")),
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
      .create = tunica::ceres_lm::create});
}
