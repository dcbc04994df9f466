// SPDX-License-Identifier: Apache-2.0
#include "search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/core.h>

#include "tunica/optimizers/augmented_lagrangian.hpp"
#include "tunica/random.hpp"

namespace tunica::nlopt_plugin {
namespace {

nlopt::algorithm algorithm_of(Algorithm algorithm, Algorithm local) {
  switch (algorithm) {
    case Algorithm::crs2_lm:
      return nlopt::GN_CRS2_LM;
    case Algorithm::isres:
      return nlopt::GN_ISRES;
    case Algorithm::direct_l:
      return nlopt::GN_DIRECT_L;
    case Algorithm::mlsl:
      return uses_gradient(local) ? nlopt::GD_MLSL_LDS : nlopt::GN_MLSL_LDS;
    case Algorithm::cobyla:
      return nlopt::LN_COBYLA;
    case Algorithm::bobyqa:
      return nlopt::LN_BOBYQA;
    case Algorithm::slsqp:
      return nlopt::LD_SLSQP;
  }
  return nlopt::LN_COBYLA;
}

/// BOBYQA is not made for one dimension.
Algorithm possible(Algorithm algorithm, std::size_t n) {
  return algorithm == Algorithm::bobyqa && n == 1 ? Algorithm::cobyla : algorithm;
}

/// Measured where three evaluations in ten fail and where a region does: docs/optimizers.md.
Failed failed(Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::crs2_lm:
      return Failed::infinite;
    case Algorithm::cobyla:
    case Algorithm::bobyqa:
      return Failed::nearer;
    case Algorithm::slsqp:
      return Failed::beyond;
    default:
      return Failed::worst;
  }
}

void set_local(nlopt::opt& opt, Algorithm algorithm, const Settings& settings) {
  opt.set_xtol_abs(settings.step_tolerance);
  opt.set_ftol_rel(settings.tolerance);
  if (!uses_gradient(algorithm)) opt.set_initial_step(settings.initial_step);
}

/// Runs NLopt; its exceptions for the ends of a search become ends.
void run(nlopt::opt& opt, const Bridge& bridge, std::span<const double> from, Search& search) {
  std::vector<double> x(from.begin(), from.end());
  for (double& value : x) value = std::clamp(value, 0.0, 1.0);
  double objective = 0;
  try {
    opt.optimize(x, objective);
    search.end = Search::End::converged;
  } catch (const nlopt::roundoff_limited&) {
    search.end = Search::End::roundoff;
  } catch (const nlopt::forced_stop&) {
    search.end = Search::End::stopped;
  } catch (const std::runtime_error& error) {
    search.end = Search::End::gave_up;
    search.message = error.what();
  }
  bridge.rethrow();
  if (bridge.stop() == Bridge::Stop::stalled) search.end = Search::End::stalled;
  if (bridge.stop() == Bridge::Stop::problem) search.end = Search::End::stopped;
  if (bridge.stop() == Bridge::Stop::not_a_number) {
    search.end = Search::End::gave_up;
    search.message = "it asked for a point that is not a number";
  }
  search.evaluated += bridge.evaluated();
  if (search.failure.empty()) search.failure = bridge.failure();
  if (bridge.best().better_than(search.best)) search.best = bridge.best();
  if (search.best.x.empty() && search.end != Search::End::stopped) search.end = Search::End::nothing;
  if (bridge.stop() == Bridge::Stop::nothing_succeeded) search.end = Search::End::nothing;
}

Search run_locally(Problem& problem, std::span<const double> x, Algorithm algorithm, const Settings& settings) {
  Search search;
  Bridge bridge(problem, {.gradient = uses_gradient(algorithm), .failed = failed(algorithm)});
  nlopt::opt opt(algorithm_of(algorithm, algorithm), static_cast<unsigned>(problem.dimension()));
  bridge.attach(opt, true);
  set_local(opt, algorithm, settings);
  run(opt, bridge, x, search);
  return search;
}

void take(const AugmentedLagrangian::Point& best, Search& search) {
  search.best = {best.x, best.objective, best.violation};
  if (best.x.empty()) search.best = {};
}

/// Rounds of an algorithm that knows bounds alone: round(lagrangian, from, k), each from where the last one ended.
Search follow_multipliers(Problem& problem, std::span<const double> x,
                          const std::function<Search(Problem&, std::span<const double>, int)>& round) {
  AugmentedLagrangian lagrangian(problem);
  Search search;
  constexpr int rounds = 30;
  for (int k = 0; k < rounds; ++k) {
    const std::vector<double> from(k == 0 ? std::vector<double>(x.begin(), x.end()) : lagrangian.point().x);
    const Search last = round(lagrangian, from, k);
    search.evaluated += last.evaluated;
    search.end = last.end;
    if (search.failure.empty()) search.failure = last.failure;
    if (last.end == Search::End::stopped || last.end == Search::End::nothing) break;
    const AugmentedLagrangian::Progress progress = lagrangian.update();
    if (progress == AugmentedLagrangian::Progress::infeasible) search.end = Search::End::infeasible;
    if (progress != AugmentedLagrangian::Progress::going_on) break;
  }
  take(lagrangian.best(), search);
  return search;
}

/// ISRES improves its best point rarely: at 2000 evaluations it was stopped on its way in every test function.
std::size_t stall_of(const Settings& settings, std::size_t n) {
  if (settings.stall > 0) return settings.stall;
  return (settings.algorithm == Algorithm::isres ? 2000 : 200) * (n + 1);
}

/// MLSL. NLopt ends it with the first of its local searches that fails or comes to rounding, and forgets what it knew.
/// It is then begun again from another point, on another stretch of its sequence, until it has made no progress for as
/// long as one search may.
Search search_by_levels(Problem& problem, std::span<const double> start, const Settings& settings) {
  const auto n = static_cast<unsigned>(problem.dimension());
  const Algorithm local = possible(settings.local, n);
  const std::size_t stall = stall_of(settings, n);
  const unsigned points = settings.population > 0 ? static_cast<unsigned>(settings.population) : 4;  // NLopt's own
  Search search;
  std::size_t improved_at = 0;
  for (unsigned round = 0;; ++round) {
    Bridge bridge(
        problem,
        {.gradient = uses_gradient(local), .failed = failed(local), .stall = stall, .tolerance = settings.tolerance});
    nlopt::opt opt(algorithm_of(Algorithm::mlsl, local), n), inner(algorithm_of(local, local), n);
    bridge.attach(opt, takes_constraints(Algorithm::mlsl));
    opt.set_population(points + round);
    set_local(inner, local, settings);
    opt.set_local_optimizer(inner);
    const Point before = search.best;
    run(opt, bridge, round == 0 ? std::vector<double>(start.begin(), start.end()) : random_point(round, n), search);
    if (search.best.better_than(before)) improved_at = search.evaluated;
    if (search.end == Search::End::nothing && !search.best.x.empty()) search.end = Search::End::stalled;
    const bool cut_short = search.end == Search::End::roundoff || search.end == Search::End::gave_up;
    if (!cut_short || bridge.evaluated() == 0 || problem.should_stop()) return search;
    if (search.evaluated - improved_at < stall) continue;
    search.end = Search::End::stalled;
    return search;
  }
}

/// A quadratic penalty that remembers where it is low: the lowest evaluated points that lie apart from each other. It
/// leaves half of the evaluations for the continuation from there: a search may creep along the edge of a penalty for
/// ever.
class LowPlaces : public AugmentedLagrangian {
 public:
  explicit LowPlaces(Problem& problem) : AugmentedLagrangian(problem), last_(problem.budget() / 2) {}
  struct Place {
    std::vector<double> x;
    double value;
  };

  Status evaluate(std::span<const double> x, double& objective) override {
    Status status = AugmentedLagrangian::evaluate(x, objective);
    if (status.ok()) note(x, objective);
    return status;
  }
  Status linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                   std::span<double> jacobian) override {
    Status status = AugmentedLagrangian::linearise(x, objective, residuals, jacobian);
    if (status.ok()) note(x, objective);
    return status;
  }
  [[nodiscard]] bool should_stop() const override { return AugmentedLagrangian::should_stop() || budget() <= last_; }
  /// From the lowest.
  [[nodiscard]] const std::vector<Place>& places() const { return places_; }

 private:
  static constexpr std::size_t most = 20;
  static constexpr double apart = 0.05;  ///< of the box, in some parameter

  static bool near(std::span<const double> a, std::span<const double> b) {
    for (std::size_t j = 0; j < a.size(); ++j)
      if (std::abs(a[j] - b[j]) > apart) return false;
    return true;
  }
  void note(std::span<const double> x, double value) {
    if (!(places_.size() < most || value < places_.back().value)) return;
    if (std::ranges::any_of(places_, [&](const Place& one) { return one.value <= value && near(one.x, x); })) return;
    std::erase_if(places_, [&](const Place& one) { return near(one.x, x); });
    const auto after = std::ranges::find_if(places_, [value](const Place& one) { return one.value > value; });
    places_.insert(after, {std::vector<double>(x.begin(), x.end()), value});
    if (places_.size() > most) places_.pop_back();
  }

  std::uint64_t last_;  ///< of the budget, which stays
  std::vector<Place> places_;
};

/// MLSL on a quadratic penalty until it stalls, then its local algorithm, which meets the constraints, from the best
/// point and from each place where the penalty is low: the lowest of them need not lead to the constrained optimum.
Search search_in_two_steps(Problem& problem, std::span<const double> start, const Settings& settings) {
  LowPlaces penalised(problem);
  Search search = search_by_levels(penalised, start, settings);
  take(penalised.best(), search);
  if (problem.should_stop() || search.end == Search::End::nothing) return search;
  std::vector<std::vector<double>> starts{search.best.x.empty() ? std::vector<double>(start.begin(), start.end())
                                                                : search.best.x};
  for (const LowPlaces::Place& place : penalised.places()) starts.push_back(place.x);
  for (const auto& from : starts) {
    if (problem.should_stop()) break;
    Search local = search_locally(problem, from, settings.local, settings);
    search.evaluated += local.evaluated;
    if (search.failure.empty()) search.failure = local.failure;
    if (search.best.x.empty() || !search.best.better_than(local.best)) {
      search.best = std::move(local.best);
      search.end = local.end;
      search.message = std::move(local.message);
    }
  }
  return search;
}

}  // namespace

std::string Search::words() const {
  switch (end) {
    case End::converged:
      return "it met a tolerance";
    case End::roundoff:
      return "rounding left no further progress";
    case End::stalled:
      return "it made no more progress";
    case End::infeasible:
      return "the constraints could not be met";
    case End::gave_up:
      return fmt::format("NLopt gave up: {}", message);
    case End::stopped:
      return "it was still under way";
    case End::nothing:
      return "nothing could be evaluated";
  }
  return "";
}

std::vector<double> random_point(std::uint64_t seed, std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t j = 0; j < n; ++j)
    x[j] = static_cast<double>(derive_seed(seed, fmt::format("coordinate {}", j)) >> 11) * 0x1p-53;
  return x;
}

Search search_globally(Problem& problem, std::span<const double> start, std::uint64_t seed, const Settings& settings) {
  const Algorithm algorithm = settings.algorithm;
  if (algorithm == Algorithm::mlsl && problem.constraint_count() == 0)
    return search_by_levels(problem, start, settings);
  const bool constrained = problem.constraint_count() > 0;
  if (algorithm == Algorithm::mlsl && constrained) return search_in_two_steps(problem, start, settings);
  if (algorithm == Algorithm::direct_l && constrained) {
    return follow_multipliers(problem, start, [&](Problem& lagrangian, std::span<const double> from, int /*round*/) {
      return search_globally(lagrangian, from, seed, settings);
    });
  }
  // NLopt has one generator per thread. Evaluations are serial here, so no other search uses it in between.
  nlopt::srand(static_cast<unsigned long>(seed));
  Bridge bridge(problem, {.infeasible = algorithm == Algorithm::crs2_lm ? Infeasible::ranked : Infeasible::as_is,
                          .failed = failed(algorithm),
                          .stall = stall_of(settings, problem.dimension()),
                          .tolerance = settings.tolerance});
  nlopt::opt opt(algorithm_of(algorithm, algorithm), static_cast<unsigned>(problem.dimension()));
  bridge.attach(opt, takes_constraints(algorithm));
  if (settings.population > 0) opt.set_population(static_cast<unsigned>(settings.population));
  Search search;
  run(opt, bridge, start, search);
  return search;
}

Search search_locally(Problem& problem, std::span<const double> x, Algorithm algorithm, const Settings& settings) {
  algorithm = possible(algorithm, problem.dimension());
  if (problem.constraint_count() > 0 && !takes_constraints(algorithm)) {
    return follow_multipliers(problem, x, [&](Problem& lagrangian, std::span<const double> from, int round) {
      Settings shorter = settings;
      shorter.initial_step = std::max(settings.initial_step * std::pow(0.3, round), 1e-4);
      return run_locally(lagrangian, from, algorithm, shorter);
    });
  }
  return run_locally(problem, x, algorithm, settings);
}

}  // namespace tunica::nlopt_plugin
