// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de1220.hpp>
#include <pagmo/algorithms/pso_gen.hpp>
#include <pagmo/algorithms/sade.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/batch_evaluators/member_bfe.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/problem.hpp>

#include "pagmo_optimizer.hpp"
#include "part.hpp"

namespace tunica::pagmo_plugin {
namespace {

// Generations are not what ends a search: see Search.
constexpr unsigned generations = std::numeric_limits<unsigned>::max() / 4;

/// What pagmo calls a user-defined batch evaluator.
struct Generation {
  Search* search = nullptr;
  pagmo::vector_double operator()(const pagmo::problem& /*problem*/, const pagmo::vector_double& xs) const {
    return search->fitnesses(xs);
  }
};

pagmo::algorithm algorithm(Method method, unsigned seed, Search& search) {
  switch (method) {
    case Method::sade:
      return pagmo::algorithm(pagmo::sade(generations, 2, 1, 0, 0, false, seed));
    case Method::de1220:
      return pagmo::algorithm(
          pagmo::de1220(generations, pagmo::de1220_statics<void>::allowed_variants, 1, 0, 0, false, seed));
    case Method::pso: {
      pagmo::pso_gen swarm(generations, 0.7298, 2.05, 2.05, 0.5, 5, 2, 4, false, seed);
      swarm.set_bfe(pagmo::bfe(Generation{&search}));
      return pagmo::algorithm(std::move(swarm));
    }
    case Method::ga:
      return pagmo::algorithm(pagmo::sga(generations, 0.9, 10, 0.1, 50, 2, "sbx", "polynomial", "tournament", seed));
    case Method::cmaes:
      break;
  }
  return pagmo::algorithm(pagmo::cmaes(generations, -1, -1, -1, -1, 0.3, 0, 0, false, true, seed));
}

}  // namespace
}  // namespace tunica::pagmo_plugin

extern "C" tunica::Optimizer* tunica_pagmo_search(tunica::pagmo_plugin::Method method, const tunica::Options& given) {
  using namespace tunica::pagmo_plugin;
  return new PagmoOptimizer(
      Settings{.algorithm = [method](unsigned seed, Search& search) { return algorithm(method, seed, search); },
               .population = given.count("population"),
               .restarts = given.count("restarts"),
               .restart_growth = given.number("restart_growth"),
               .stall_generations = given.count("stall_generations"),
               .tolerance = given.number("tolerance")});
}
