// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

#include <cmath>

#include "../es/evolution_strategy.hpp"
#include "../es/search_options.hpp"

// CMA-ES is the evolution strategy of ../es with everything chosen as Hansen does: comma selection, the weighted mean
// of the better half, cumulative steps, rank-one and rank-μ updates. Its sources are compiled here once more.
namespace tunica::cma_es {
namespace {

std::vector<Option> declared() {
  std::vector<Option> options{
      Option::integer("population", 0, {0, 1e6},
                      "Points a generation, λ; the better half are the parents. 0 means 4 + 3 ln n for n parameters.")};
  const std::vector<Option> common = es::search_options(0.3);
  options.insert(options.end(), common.begin(), common.end());
  return options;
}

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
  es::Settings settings{.selection = es::Selection::comma,
                        .adaptation = es::Adaptation::covariance,
                        .step_control = es::StepControl::cumulative,
                        .recombination = es::Recombination::global,
                        .bounds = es::Bounds::reflect,
                        .infeasible = es::Infeasible::rank_by_violation};
  es::set_search_options(given, settings);
  return std::make_unique<CmaEs>(given.count("population"), settings);
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
      .options = tunica::cma_es::declared(),
      .create = tunica::cma_es::create});
}
