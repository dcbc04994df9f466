// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

#include <cmath>

#include "../es/evolution_strategy.hpp"

// CMA-ES is the evolution strategy of ../es with everything chosen as Hansen does: comma selection, the weighted mean
// of the better half, cumulative steps, rank-one and rank-μ updates. Its sources are compiled here once more.
namespace tunica::cma_es {
namespace {

using Kind = Option::Kind;

const std::vector<Option> options = {
    {.name = "population",
     .kind = Kind::integer,
     .fallback = std::int64_t{0},
     .doc = "Points a generation, λ; the better half are the parents. 0 means 4 + 3 ln n for n parameters.",
     .min = 0,
     .max = 1e7},
    {.name = "initial_step",
     .kind = Kind::number,
     .fallback = 0.3,
     .doc = "First standard deviation of the mutations, as a fraction of the range of each parameter.",
     .min = 1e-6,
     .max = 1},
    {.name = "restarts",
     .kind = Kind::integer,
     .fallback = std::int64_t{10},
     .doc = "Further searches from new random points after one has converged or stalled, as far as the stop block "
            "allows.",
     .min = 0,
     .max = 1e6},
    {.name = "restart_growth",
     .kind = Kind::number,
     .fallback = 2.0,
     .doc = "Factor on the population at every restart; 1 keeps it.",
     .min = 1,
     .max = 10},
    {.name = "stall_generations",
     .kind = Kind::integer,
     .fallback = std::int64_t{30},
     .doc = "A search ends after so many generations without progress.",
     .min = 1,
     .max = 1e6},
    {.name = "tolerance",
     .kind = Kind::number,
     .fallback = 1e-9,
     .doc = "Relative improvement of the objective that counts as progress.",
     .min = 0,
     .max = 1},
    {.name = "step_tolerance",
     .kind = Kind::number,
     .fallback = 1e-12,
     .doc = "A search ends when the mean mutation is shorter than this fraction of the range.",
     .min = 0,
     .max = 1},
};

/// The strategy with a population that depends on the problem's dimension.
class CmaEs : public Optimizer {
 public:
  CmaEs(std::size_t population, const es::Settings& settings) : population_(population), settings_(settings) {}
  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem& problem) override {
    // λ = 4 + ⌊3 ln n⌋ (Hansen 2016, table 1)
    const auto n = static_cast<double>(std::max<std::size_t>(problem.dimension(), 1));
    es::Settings settings = settings_;
    settings.offspring = population_ > 0 ? population_ : 4 + static_cast<std::size_t>(3 * std::log(n));
    settings.offspring = std::max<std::size_t>(settings.offspring, 2);
    settings.parents = settings.offspring / 2;
    return es::EvolutionStrategy(settings).minimise(problem);
  }

 private:
  std::size_t population_;
  es::Settings settings_;
  Needs needs_{.constraints = true, .batch = true, .random = true};
};

std::unique_ptr<Optimizer> create(const Options& given) {
  return std::make_unique<CmaEs>(
      static_cast<std::size_t>(given.integer("population")),
      es::Settings{.parents = 0,
                   .offspring = 0,
                   .selection = es::Selection::comma,
                   .adaptation = es::Adaptation::covariance,
                   .step_control = es::StepControl::cumulative,
                   .recombination = es::Recombination::global,
                   .bounds = es::Bounds::reflect,
                   .infeasible = es::Infeasible::rank_by_violation,
                   .initial_step = given.number("initial_step"),
                   .restarts = static_cast<std::size_t>(given.integer("restarts")),
                   .restart_growth = given.number("restart_growth"),
                   .stall_generations = static_cast<std::size_t>(given.integer("stall_generations")),
                   .tolerance = given.number("tolerance"),
                   .step_tolerance = given.number("step_tolerance")});
}

}  // namespace
}  // namespace tunica::cma_es

TUNICA_PLUGIN("cma_es", "0.1.0") {
  registry.add(tunica::OptimizerFactory{
      .type = "cma_es",
      .doc = "CMA-ES with restarts of growing population, for objectives with valleys or several minima; needs no "
             "derivatives.",
      .reference = "N. Hansen, The CMA evolution strategy: a tutorial, arXiv:1604.00772 (2016); "
                   "A. Auger, N. Hansen, A restart CMA evolution strategy with increasing population size, CEC (2005) "
                   "1769-1776; K. Deb, Comput. Methods Appl. Mech. Eng. 186 (2000) 311-338 (constraints).",
      .options = tunica::cma_es::options,
      .create = tunica::cma_es::create});
}
