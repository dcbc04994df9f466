// SPDX-License-Identifier: Apache-2.0
#include "multi_start.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/core.h>

#include "descent.hpp"
#include "starts.hpp"
#include "tunica/optimizers/start_of_search.hpp"
#include "tunica/random.hpp"

namespace tunica::ceres_lm {
namespace {

const char* words(Descent::End end) {
  switch (end) {
    case Descent::End::converged:
      return "it met a tolerance";
    case Descent::End::out_of_iterations:
      return "it used up its iterations (max_iterations)";
    case Descent::End::blocked:
      return "no step from its last point could be evaluated";
    case Descent::End::infeasible:
      return "the constraints could not be met";
    case Descent::End::stopped:
      return "it was still under way";
    case Descent::End::not_started:
      return "it could not be evaluated";
  }
  return "";
}

/// By violation, zero for all feasible ones, then by objective; in `rank` ties keep the order of the starts.
bool better(const Descent& a, const Descent& b) {
  if (a.evaluated != b.evaluated) return a.evaluated;
  if (a.violation != b.violation) return a.violation < b.violation;
  return a.evaluated && a.objective < b.objective;
}

std::vector<std::size_t> rank(const std::vector<Descent>& descents) {
  std::vector<std::size_t> order(descents.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return better(descents[a], descents[b]); });
  return order;
}

/// Descends from x of each listed descent and puts the result in its place, of those that were begun in time.
void descend_all(Problem& problem, const std::vector<std::size_t>& which, std::vector<Descent>& descents,
                 int max_iterations, const Settings& settings) {
  std::vector<Descent> made(which.size());
  const std::size_t begun = problem.for_each_start(which.size(), [&](std::size_t k, Problem& child) {
    made[k] = descend(child, start_of_search(problem, child, descents[which[k]].x), max_iterations, settings);
  });
  // The last of them may have gone on beyond the stop.
  if (begun > 0 && problem.should_stop()) made[begun - 1].end = Descent::End::stopped;
  for (std::size_t k = 0; k < begun; ++k) {
    Descent& descent = descents[which[k]];
    if (made[k].evaluated || !descent.evaluated) descent = std::move(made[k]);
  }
}

/// Every start, those that cannot be evaluated replaced a few times over.
std::vector<Descent> descend_from_starts(Problem& problem, int max_iterations, const Settings& settings) {
  const std::size_t n = problem.dimension();
  std::vector<Descent> descents(settings.starts);
  std::vector<std::size_t> which(settings.starts);
  std::iota(which.begin(), which.end(), std::size_t{0});
  const std::uint64_t seed = problem.seed("ceres_lm");
  constexpr int rounds = 5;
  for (int round = 0; round < rounds && !which.empty() && !problem.should_stop(); ++round) {
    const auto points =
        spread_points(settings.sampling, which.size(), n, derive_seed(seed, fmt::format("starts {}", round)));
    for (std::size_t k = 0; k < which.size(); ++k) {
      const auto row = points.begin() + static_cast<std::ptrdiff_t>(k * n);
      descents[which[k]].x.assign(row, row + static_cast<std::ptrdiff_t>(n));
    }
    if (round == 0) descents[0].x.assign(problem.start().begin(), problem.start().end());
    descend_all(problem, which, descents, max_iterations, settings);
    std::erase_if(which, [&](std::size_t i) { return descents[i].evaluated; });
  }
  return descents;
}

}  // namespace

Optimizer::Outcome MultiStart::minimise(Problem& problem) {
  if (problem.dimension() == 0) {
    double objective = 0;
    const Status status = problem.evaluate({}, objective);
    return {status.kind() != Status::Kind::failed, "no parameter is free: one evaluation made"};
  }
  if (problem.residual_count() == 0) return {false, "the objective has no residuals to reduce"};
  const bool screening = settings_.screening_iterations > 0 && settings_.polished < settings_.starts;
  const int first_iterations = screening ? settings_.screening_iterations : settings_.max_iterations;
  std::vector<Descent> descents = descend_from_starts(problem, first_iterations, settings_);
  std::vector<std::size_t> order = rank(descents);
  if (screening && !problem.should_stop()) {
    std::vector<std::size_t> unfinished(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(settings_.polished));
    std::erase_if(unfinished, [&](std::size_t i) { return descents[i].end != Descent::End::out_of_iterations; });
    descend_all(problem, unfinished, descents, settings_.max_iterations, settings_);
    order = rank(descents);
  }

  const Descent& best = descents[order[0]];
  const auto evaluated = std::ranges::count_if(descents, &Descent::evaluated);
  if (evaluated == 0) {
    const auto tried = std::ranges::find_if(descents, [](const Descent& descent) { return !descent.failure.empty(); });
    if (tried == descents.end()) return {false, "stopped before the first evaluation"};
    return {false, problem.should_stop()
                       ? fmt::format("stopped before any start could be evaluated; a reason: {}", tried->failure)
                       : fmt::format("none of the {} starts could be evaluated, nor the points drawn in their place; a "
                                     "reason: {}",
                                     settings_.starts, tried->failure)};
  }
  // Starts that agree are the reader's evidence that the optimum is not a local one.
  const auto agree = std::ranges::count_if(descents, [&](const Descent& descent) {
    return descent.evaluated && descent.violation == best.violation &&
           descent.objective - best.objective <= 1e-6 * std::abs(best.objective);
  });
  const auto made = std::ranges::count_if(
      descents, [](const Descent& descent) { return descent.evaluated || !descent.failure.empty(); });
  const bool infeasible = best.violation > 0, cut_short = static_cast<std::size_t>(made) < settings_.starts;
  return {
      best.end == Descent::End::converged && !infeasible,
      fmt::format(
          "{}{}{} of {} could be evaluated, {} came to the best objective; the best was start {}: {}",
          problem.should_stop() ? "stopped; " : "",
          infeasible ? fmt::format("no feasible point was found, the least violation was {:g}; ", best.violation) : "",
          evaluated,
          cut_short ? fmt::format("the {} starts (of {}) made until then", made, settings_.starts)
                    : fmt::format("{} starts", settings_.starts),
          agree, order[0] + 1, words(best.end))};
}

}  // namespace tunica::ceres_lm
