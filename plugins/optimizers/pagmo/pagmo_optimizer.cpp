// SPDX-License-Identifier: Apache-2.0
#include "pagmo_optimizer.hpp"

#include <cmath>

#include <fmt/core.h>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "tunica/random.hpp"

namespace tunica::pagmo_plugin {
namespace {

/// What pagmo calls a user-defined problem.
struct UnitBox {
  Search* search = nullptr;
  std::size_t n = 1;
  [[nodiscard]] pagmo::vector_double fitness(const pagmo::vector_double& x) const { return {search->fitness(x)}; }
  [[nodiscard]] std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(n, 0.0), pagmo::vector_double(n, 1.0)};
  }
};

double unit(std::uint64_t seed, std::size_t i) {
  return static_cast<double>(derive_seed(seed, fmt::format("coordinate {}", i)) >> 11) * 0x1p-53;
}

enum class End { stopped, stalled, nothing };

/// From a random population to one of the three ends.
End run(Search& search, std::span<const double> start, std::size_t size, std::uint64_t seed, const Settings& settings) {
  const std::size_t n = search.dimension();
  try {
    pagmo::vector_double points(size * n);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = i < start.size() ? start[i] : unit(seed, i);
    const pagmo::vector_double fitnesses = search.fitnesses(points);
    pagmo::population population{UnitBox{&search, n}, 0, static_cast<unsigned>(derive_seed(seed, "population"))};
    for (std::size_t k = 0; k < size; ++k) {
      const auto row = points.begin() + static_cast<std::ptrdiff_t>(k * n);
      population.push_back({row, row + static_cast<std::ptrdiff_t>(n)}, {fitnesses[k]});
    }
    const pagmo::algorithm algorithm =
        settings.algorithm(static_cast<unsigned>(derive_seed(seed, "algorithm")), search);
    while (true) population = algorithm.evolve(population);
  } catch (const Search::Stopped&) {
    return End::stopped;
  } catch (const Search::Stalled&) {
    return End::stalled;
  } catch (const Search::NothingSucceeded&) {
    return End::nothing;
  }
}

}  // namespace

Optimizer::Outcome PagmoOptimizer::minimise(Problem& problem) {
  const std::size_t n = problem.dimension();
  if (n == 0) {
    double objective = 0;
    const Status status = problem.evaluate({}, objective);
    return {status.kind() != Status::Kind::failed, "no parameter is free: one evaluation made"};
  }
  const std::uint64_t seed = problem.seed("pagmo");
  double size =
      static_cast<double>(settings_.population > 0 ? settings_.population : std::max<std::size_t>(20, 10 * n));
  Search::Best best;
  bool best_had_ended = false;
  for (std::size_t k = 0; k <= settings_.restarts; ++k, size *= settings_.restart_growth) {
    const auto members = 4 * static_cast<std::size_t>(std::ceil(size / 4));  // sga pairs its members
    Search search(problem, settings_.stall_generations * members, settings_.tolerance);
    const auto start = k == 0 ? problem.start() : std::span<const double>{};
    const End end = run(search, start, members, derive_seed(seed, fmt::format("search {}", k)), settings_);
    if (search.best().fitness < best.fitness) {
      best = search.best();
      best_had_ended = end == End::stalled;
    }
    if (best.x.empty()) {
      return {false, search.failure().empty()
                         ? "stopped before the first evaluation"
                         : fmt::format("stopped: none of {} points could be evaluated; the first reason: {}",
                                       search.evaluated(), search.failure())};
    }
    if (end == End::stopped) {
      return {best_had_ended && best.feasible(),
              fmt::format("stopped in search {} of {}; {}", k + 1, settings_.restarts + 1,
                          !best.feasible() ? "no feasible point was found"
                          : best_had_ended ? "the search that found the best point had made no more progress"
                                           : "the search that found the best point was still under way")};
    }
  }
  return {best.feasible(), fmt::format("all {} searches made no more progress{}", settings_.restarts + 1,
                                       best.feasible() ? "" : "; no feasible point was found")};
}

}  // namespace tunica::pagmo_plugin
