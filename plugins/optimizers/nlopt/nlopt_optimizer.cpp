// SPDX-License-Identifier: Apache-2.0
#include "nlopt_optimizer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/core.h>

#include "search.hpp"
#include "tunica/optimizers/start_of_search.hpp"
#include "tunica/random.hpp"

namespace tunica::nlopt_plugin {
namespace {

std::string infeasibility(const Point& best) {
  return best.violation > 0 ? fmt::format("no feasible point was found, the least violation was {:g}; ", best.violation)
                            : std::string();
}

std::string nothing_evaluated(std::size_t count, const std::string& failure) {
  return failure.empty()
             ? "stopped before the first evaluation"
             : fmt::format("stopped: none of {} points could be evaluated; the first reason: {}", count, failure);
}

bool random_numbers(const Settings& settings) {
  if (is_local(settings.algorithm)) return settings.starts > 1;
  // The points of MLSL are a low-discrepancy sequence, which NLopt does not randomise.
  return settings.algorithm == Algorithm::crs2_lm || settings.algorithm == Algorithm::isres;
}

}  // namespace

NloptOptimizer::NloptOptimizer(const Settings& settings) : settings_(settings) {
  const Algorithm algorithm = settings.algorithm;
  const bool gradient = uses_gradient(algorithm == Algorithm::mlsl ? settings.local : algorithm);
  needs_ = {.residuals = gradient,
            .gradient = gradient,
            .constraints = true,
            .random = random_numbers(settings),
            .infeasible = algorithm != Algorithm::crs2_lm};
  // A simplex of n + 1 points is drawn from the population.
  if (algorithm == Algorithm::crs2_lm && settings.population > 0) needs_.most_parameters = settings.population - 1;
}

Optimizer::Outcome NloptOptimizer::minimise(Problem& problem) {
  if (problem.dimension() == 0) {
    double objective = 0;
    const Status status = problem.evaluate({}, objective);
    return {status.kind() != Status::Kind::failed, "no parameter is free: one evaluation made"};
  }
  return is_local(settings_.algorithm) ? minimise_from_starts(problem) : minimise_globally(problem);
}

Optimizer::Outcome NloptOptimizer::minimise_globally(Problem& problem) const {
  const std::uint64_t seed = problem.seed("nlopt");
  const std::size_t searches = needs_.random ? settings_.restarts + 1 : 1;
  Search best;
  std::size_t evaluated = 0;
  std::string failure;
  for (std::size_t k = 0; k < searches; ++k) {
    const std::uint64_t own = derive_seed(seed, fmt::format("search {}", k));
    const std::vector<double> start = k == 0 ? std::vector<double>(problem.start().begin(), problem.start().end())
                                             : random_point(own, problem.dimension());
    Search search = search_globally(problem, start, own, settings_);
    evaluated += search.evaluated;
    if (failure.empty()) failure = search.failure;
    const Search::End end = search.end;
    if (k == 0 || search.best.better_than(best.best)) best = std::move(search);
    if (best.best.x.empty()) return {false, nothing_evaluated(evaluated, failure)};
    if (end == Search::End::stopped) {
      return {best.converged(), fmt::format("stopped in search {} of {}; {}the search that found the best point: {}",
                                            k + 1, searches, infeasibility(best.best), best.words())};
    }
  }
  return {best.converged(), fmt::format("{} searches ended; {}the one that found the best point: {}", searches,
                                        infeasibility(best.best), best.words())};
}

Optimizer::Outcome NloptOptimizer::minimise_from_starts(Problem& problem) const {
  const std::uint64_t seed = problem.seed("nlopt");
  std::vector<Search> searches(settings_.starts);
  std::vector<std::size_t> which(settings_.starts);
  std::iota(which.begin(), which.end(), std::size_t{0});
  std::size_t evaluated = 0;
  constexpr int rounds = 5;  // points that cannot be evaluated are replaced
  for (int round = 0; round < rounds && !which.empty() && !problem.should_stop(); ++round) {
    const std::size_t begun = problem.for_each_start(which.size(), [&](std::size_t k, Problem& child) {
      const std::size_t i = which[k];
      const std::vector<double> x =
          i == 0 && round == 0 ? std::vector<double>(child.start().begin(), child.start().end())
                               : start_of_search(problem, child,
                                                 random_point(derive_seed(seed, fmt::format("start {} {}", i, round)),
                                                              child.dimension()));
      searches[i] = search_locally(child, x, settings_.algorithm, settings_);
    });
    for (std::size_t k = begun; k < which.size(); ++k) searches[which[k]] = {};  // too late to count
    if (begun > 0 && problem.should_stop()) searches[which[begun - 1]].end = Search::End::stopped;
    for (const std::size_t i : which) evaluated += searches[i].evaluated;
    std::erase_if(which, [&](std::size_t i) { return !searches[i].best.x.empty(); });
  }
  const auto best =
      std::ranges::min_element(searches, [](const Search& a, const Search& b) { return a.best.better_than(b.best); });
  if (best->best.x.empty()) {
    const auto tried = std::ranges::find_if(searches, [](const Search& search) { return !search.failure.empty(); });
    return {false, nothing_evaluated(evaluated, tried == searches.end() ? std::string() : tried->failure)};
  }
  const auto agree = std::ranges::count_if(searches, [&](const Search& search) {
    return search.best.violation == best->best.violation &&
           search.best.objective - best->best.objective <= 1e-6 * std::abs(best->best.objective);
  });
  const auto number = best - searches.begin() + 1;
  const auto made = std::ranges::count_if(searches, [](const Search& search) { return search.evaluated > 0; });
  const bool cut_short = static_cast<std::size_t>(made) < settings_.starts;
  return {
      best->converged(),
      fmt::format("{}{}{} of {} could be evaluated, {} came to the best objective; the best was start {}: {}",
                  problem.should_stop() ? "stopped; " : "", infeasibility(best->best), settings_.starts - which.size(),
                  cut_short ? fmt::format("the {} starts (of {}) made until then", made, settings_.starts)
                            : fmt::format("{} starts", settings_.starts),
                  agree, number, best->words())};
}

}  // namespace tunica::nlopt_plugin
