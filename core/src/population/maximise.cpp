// SPDX-License-Identifier: Apache-2.0
#include "population/maximise.hpp"

#include <algorithm>
#include <cmath>

#include <nlopt.hpp>

namespace tunica::population {
namespace {

constexpr double least_start = 0.05;  // of a spread, in scales
constexpr double nothing = 1e-5;      // a spread below, in scales, is zero

struct Target {
  const LinearModel& model;
  const Coordinates& coordinates;
  std::vector<double> best;
  double value = HUGE_VAL;
};

double objective(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
  Target& target = *static_cast<Target*>(data);
  VarianceGradient by_variance;
  const double value = target.model.value(target.coordinates.variances(x), gradient.empty() ? nullptr : &by_variance);
  if (!std::isfinite(value)) {
    std::fill(gradient.begin(), gradient.end(), 0.0);
    return 1e30;
  }
  if (!gradient.empty()) target.coordinates.chain(x, by_variance, gradient.data());
  if (value < target.value) {
    target.value = value;
    target.best = x;
  }
  return value;
}

bool search(Target& target, const std::vector<double>& start, std::optional<std::size_t> held) {
  std::vector<double> lower = target.coordinates.lower(), upper = target.coordinates.upper(), x = start;
  if (held) lower[*held] = upper[*held] = start[*held];
  nlopt::opt opt(nlopt::LD_SLSQP, static_cast<unsigned>(x.size()));
  opt.set_lower_bounds(lower);
  opt.set_upper_bounds(upper);
  opt.set_min_objective(objective, &target);
  opt.set_ftol_abs(1e-12);
  opt.set_xtol_abs(1e-9);
  opt.set_maxeval(500);
  double value = 0;
  try {
    return opt.optimize(x, value) != nlopt::MAXEVAL_REACHED;
  } catch (const nlopt::roundoff_limited&) {
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// Lifts the spreads of x that rest at zero although the likelihood rises off it. True where there is one.
bool lift(const LinearModel& model, const Coordinates& coordinates, std::optional<std::size_t> held,
          std::vector<double>& x) {
  VarianceGradient by_variance;
  model.value(coordinates.variances(x), &by_variance);
  bool lifted = false;
  for (const Coordinates::Spread& spread : coordinates.spreads()) {
    const auto j = static_cast<Eigen::Index>(spread.parameter);
    const double slope = spread.between ? by_variance.between(j, j) : by_variance.within(j, j);
    if (spread.coordinate == held || x[spread.coordinate] > nothing || slope >= 0) continue;
    x[spread.coordinate] = least_start;
    lifted = true;
  }
  return lifted;
}

}  // namespace

Maximum maximise(const LinearModel& model, const Coordinates& coordinates, std::vector<double> x,
                 std::optional<std::size_t> held) {
  for (const Coordinates::Spread& spread : coordinates.spreads())
    if (spread.coordinate != held) x[spread.coordinate] = std::max(x[spread.coordinate], least_start);
  Target target{model, coordinates, x};
  bool converged = search(target, x, held);
  x = target.best;
  if (target.value < HUGE_VAL && lift(model, coordinates, held, x)) converged = search(target, x, held);
  for (const Coordinates::Spread& spread : coordinates.spreads()) {
    double& value = target.best[spread.coordinate];
    if (spread.coordinate != held && value < nothing) value = 0;
  }
  return {target.best, model.value(coordinates.variances(target.best)), converged};
}

}  // namespace tunica::population
