// SPDX-License-Identifier: Apache-2.0
#include "evolution_strategy.hpp"

#include <cmath>

#include <fmt/core.h>

#include "search.hpp"

namespace tunica::es {
namespace {

const char* words(End end) {
  switch (end) {
    case End::small_step:
      return "its step fell below the tolerance";
    case End::alike:
      return "its parents became equal to within rounding";
    case End::stalled:
      return "it made no more progress";
    case End::stopped:
      return "it was still under way";
    case End::nothing_succeeded:
      return "nothing could be evaluated";
  }
  return "";
}

/// As Fitness orders, but for the index.
bool better(Fitness a, Fitness b) {
  a.index = b.index = 0;
  return a < b;
}

std::string infeasibility(const Fitness& best) {
  return best.kind == Status::Kind::ok ? "" : "no feasible point was found; ";
}

std::size_t grown(std::size_t count, double factor) {
  return static_cast<std::size_t>(std::llround(static_cast<double>(count) * factor));
}

}  // namespace

Optimizer::Outcome EvolutionStrategy::minimise(Problem& problem) {
  if (problem.dimension() == 0) {
    double objective = 0;
    const Status status = problem.evaluate({}, objective);
    return {status.kind() != Status::Kind::failed, "no parameter is free: one evaluation made"};
  }
  Random random(problem.seed("es"));
  Settings settings = settings_;
  std::optional<Fitness> best;
  End best_end = End::nothing_succeeded;
  for (std::size_t restart = 0; restart <= settings_.restarts; ++restart) {
    Search search(problem, settings, random);
    const End end = search.run(restart == 0);
    if (end == End::nothing_succeeded && !best) {
      return {false, fmt::format("none of {} random points could be evaluated; the first reason: {}",
                                 search.evaluated(), search.first_failure())};
    }
    // Indices are a search's own: of equal searches the first one keeps the title.
    if (search.best() && (!best || better(*search.best(), *best))) {
      best = search.best();
      best_end = end;
    }
    if (end == End::stopped) {
      if (!best) {
        return {false,
                search.first_failure().empty()
                    ? "stopped before the first evaluation"
                    : fmt::format("stopped before any of {} random points could be evaluated; the first reason: {}",
                                  search.evaluated(), search.first_failure())};
      }
      return {best_end != End::stopped && best->kind == Status::Kind::ok,
              fmt::format("stopped in search {} of {}; {}the search that found the best point: {}", restart + 1,
                          settings_.restarts + 1, infeasibility(*best), words(best_end))};
    }
    settings.parents = grown(settings.parents, settings_.restart_growth);
    settings.offspring = grown(settings.offspring, settings_.restart_growth);
  }
  return {best->kind == Status::Kind::ok, fmt::format("all {} searches ended; {}the one that found the best point: {}",
                                                      settings_.restarts + 1, infeasibility(*best), words(best_end))};
}

}  // namespace tunica::es
