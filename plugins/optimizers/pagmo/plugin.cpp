// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

#include <fmt/core.h>

#include "part.hpp"
#include "tunica/error.hpp"

namespace tunica::pagmo_plugin {
namespace {

std::vector<Option> with_common(std::vector<Option> own) {
  const std::vector<Option> common = {
      Option::integer("population", 0, {0, 1e6},
                      "Number of individuals, rounded up to a multiple of four; 0 means ten a parameter, and at least "
                      "20."),
      Option::integer("restarts", 10, {0, 1e6},
                      "Further searches from new random populations after one made no more progress."),
      Option::number("restart_growth", 2, {1, 10}, "Factor on the population at every restart; 1 keeps it."),
      Option::integer("stall_generations", 50, {1, 1e6},
                      "A search ends after this many populations' evaluations without progress."),
      Option::number("tolerance", 1e-9, {0, 1}, "Relative improvement of the objective that counts as progress.")};
  own.insert(own.end(), common.begin(), common.end());
  return own;
}

/// `least`: individuals that pagmo insists on.
std::unique_ptr<Optimizer> make(const Options& given, std::int64_t least, Method method) {
  if (const std::int64_t population = given.integer("population"); population > 0 && population < least)
    throw InputError(
        fmt::format("a population of {} is too small, {} is the least; 0 leaves it to the number of parameters",
                    population, least));
  return search_with(method, given);
}

OptimizerFactory differential_evolution() {
  return {.type = "pagmo_de",
          .doc =
              "Self-adaptive differential evolution of pagmo, for objectives with several minima; needs no "
              "derivatives.",
          .reference =
              "S. Elsayed, R. Sarker, D. Essam, CEC 2011 (sade); J. Brest et al., IEEE Trans. Evol. Comput. 10 "
              "(2006) 646-657; F. Biscani, D. Izzo, J. Open Source Softw. 5 (2020) 2338.",
          .options = with_common({Option::choice("variant", {"sade", "de1220"}, "de1220",
                                                 "sade adapts its rates, de1220 its mutation strategies as well.")}),
          .create = [](const Options& given) {
            return make(given, 7, given.text("variant") == "sade" ? Method::sade : Method::de1220);
          }};
}

OptimizerFactory particle_swarm() {
  return {.type = "pagmo_pso",
          .doc = "Particle swarm of pagmo, whole generations at once; needs no derivatives.",
          .reference =
              "J. Kennedy, R. Eberhart, IEEE Int. Conf. Neural Networks (1995) 1942-1948; M. Clerc, J. Kennedy, "
              "IEEE Trans. Evol. Comput. 6 (2002) 58-73; F. Biscani, D. Izzo (2020).",
          .options = with_common({}),
          .create = [](const Options& given) { return make(given, 2, Method::pso); }};
}

OptimizerFactory genetic_algorithm() {
  return {.type = "pagmo_ga",
          .doc =
              "Genetic algorithm of pagmo with simulated binary crossover and polynomial mutation; needs no "
              "derivatives.",
          .reference = "K. Deb, R. B. Agrawal, Complex Systems 9 (1995) 115-148; F. Biscani, D. Izzo (2020).",
          .options = with_common({}),
          .create = [](const Options& given) { return make(given, 2, Method::ga); }};
}

OptimizerFactory covariance_matrix_adaptation() {
  return {.type = "pagmo_cmaes",
          .doc = "CMA-ES of pagmo with its way of keeping bounds, for comparison with cma_es; needs no derivatives.",
          .reference = "N. Hansen, The CMA evolution strategy: a comparing review (2006); F. Biscani, D. Izzo (2020).",
          .options = with_common({}),
          .create = [](const Options& given) { return make(given, 5, Method::cmaes); }};
}

}  // namespace
}  // namespace tunica::pagmo_plugin

TUNICA_PLUGIN("pagmo", "0.1.0") {
  registry.add(tunica::pagmo_plugin::differential_evolution());
  registry.add(tunica::pagmo_plugin::particle_swarm());
  registry.add(tunica::pagmo_plugin::genetic_algorithm());
  registry.add(tunica::pagmo_plugin::covariance_matrix_adaptation());
}
