// SPDX-License-Identifier: Apache-2.0
#include "search/guided_search.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "tunica/random.hpp"

namespace tunica::search {
namespace {

constexpr const char* stopped = "guided by cheaper tests: stopped";

}  // namespace

Correction GuidedSearch::uncorrected() const {
  const std::size_t n = guide_.layout().parameters.size();
  return {std::vector<double>(n, 0.0),
          std::vector<double>(n, 1.0),
          {},
          std::vector<double>(guide_.layout().residual_count, 0.0),
          {}};
}

bool GuidedSearch::correct(const Linearised& at, double radius, Correction& correction) const {
  const std::size_t n = at.x.size(), m = at.residuals.size();
  std::vector<double> free(n), residuals(m), jacobian(m * n);
  guide_.box().from_unit(at.x, free);
  const auto workspace = guide_.evaluator().make_workspace();
  double objective = 0;
  const Status status = guide_.evaluator().evaluate(free, objective, {}, residuals, jacobian, *workspace);
  if (status.kind() == Status::Kind::failed) return false;
  guide_.box().jacobian_to_unit(free, jacobian);
  correction.centre = at.x;
  correction.lower.resize(n);
  correction.upper.resize(n);
  for (std::size_t j = 0; j < n; ++j) {
    correction.lower[j] = std::max(0.0, at.x[j] - radius);
    correction.upper[j] = std::min(1.0, at.x[j] + radius);
  }
  correction.offset.resize(m);
  correction.slope.resize(m * n);
  for (std::size_t i = 0; i < m; ++i) correction.offset[i] = at.residuals[i] - residuals[i];
  for (std::size_t k = 0; k < m * n; ++k) correction.slope[k] = at.jacobian[k] - jacobian[k];
  return true;
}

Best GuidedSearch::search(const Correction& correction, std::span<const double> start, std::uint64_t evaluations,
                          int round) {
  CalibrationProblem::Settings settings;
  settings.stop = settings_.stop;
  settings.stop.max_evaluations = evaluations;
  settings.stop.target.reset();
  settings.interrupted = settings_.interrupted;
  settings.seed = derive_seed(settings_.seed, fmt::format("guide {}", round));
  if (settings_.paired_starts)
    settings.paired_starts = derive_seed(*settings_.paired_starts, fmt::format("guide {}", round));
  settings.skip_costly = settings_.skip_costly;
  settings.correction = &correction;
  settings.elapsed_before =
      settings_.elapsed_before + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  for (std::size_t j = 0; j < start.size(); ++j)
    settings.start.push_back(
        std::clamp((start[j] - correction.lower[j]) / (correction.upper[j] - correction.lower[j]), 0.0, 1.0));
  CalibrationProblem cheap(guide_, std::move(settings));
  minimise_(cheap);
  evaluations_ += cheap.tally().evaluations;
  return cheap.best();
}

Optimizer::Outcome GuidedSearch::run(CalibrationProblem& costly, bool begun) {
  const std::size_t n = costly.dimension(), m = costly.residual_count();
  const std::uint64_t limit = costly.budget();
  const std::uint64_t few = std::min(limit, std::max(least_evaluations, limit / 10));
  Linearised centre{{costly.start().begin(), costly.start().end()}, std::vector<double>(m), std::vector<double>(m * n)},
      trial = centre;
  if (!begun) {
    const Best first = search(uncorrected(), centre.x, limit, 0);
    if (first.found()) guide_.box().to_unit(first.parameters, centre.x);
  }
  const auto linearise = [&](Linearised& at) {
    Status status = costly.linearise(at.x, at.objective, at.residuals, at.jacobian);
    at.violation = status.violation();
    return status;
  };
  if (costly.should_stop()) return {false, stopped};
  if (const Status status = linearise(centre); status.kind() == Status::Kind::failed)
    return {false, fmt::format("the costly tests cannot be simulated where their guides led: {}", status.reason())};
  double radius = first_radius;
  int round = 1, idle = 0;
  Correction correction;
  const auto ended = [&](const char* why) {
    return fmt::format("guided by cheaper tests: after {} rounds {}", round, why);
  };
  for (; round <= most_rounds && !costly.should_stop(); ++round) {
    if (!correct(centre, radius, correction))
      return {false, "the tests that guide the search cannot be evaluated at the best point"};
    const Best found = search(correction, centre.x, few, round);
    if (costly.should_stop()) break;
    if (!found.found()) return {false, ended("nothing near the best point could be evaluated")};
    const double promised = centre.objective - found.objective;
    const bool promising =
        found.violation < centre.violation ||
        (found.violation == centre.violation && promised > promise * std::abs(centre.objective) + perfect);
    if (!promising) {
      if (++idle == most_idle) return {true, ended("the corrected problem promises no more")};
      radius /= 4;
      continue;
    }
    idle = 0;
    guide_.box().to_unit(found.parameters, trial.x);
    const Status status = linearise(trial);
    const bool usable = status.kind() != Status::Kind::failed;
    const bool accepted = usable && is_better(trial.objective, trial.violation, centre.objective, centre.violation);
    const double kept = usable && promised > 0 ? (centre.objective - trial.objective) / promised : 0;
    if (accepted) std::swap(centre, trial);
    if (!accepted) {
      radius /= 4;
    } else if (kept < 0.25) {
      radius /= 2;
    } else if (kept > 0.75) {
      radius = std::min(2 * radius, 1.0);
    }
    if (radius < least_radius) return {true, ended("the trust region vanished")};
  }
  if (costly.should_stop()) return {false, stopped};
  return {false, fmt::format("guided by cheaper tests: {} rounds did not suffice", most_rounds)};
}

}  // namespace tunica::search
