// SPDX-License-Identifier: Apache-2.0
#include "population/spread_profile.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include <boost/math/tools/toms748_solve.hpp>
#include <oneapi/tbb/parallel_for.h>

#include "numerics/distributions.hpp"

namespace tunica::population {
namespace {

constexpr double widest_spread = 20;  // in scales, as Coordinates

/// A zero of a rising or falling function between two places of opposite sign.
double crossing(const std::function<double(double)>& f, double a, double b, double fa, double fb) {
  std::uintmax_t calls = 40;
  const auto near = [](double low, double high) { return std::abs(high - low) <= 1e-4 * std::abs(high) + 1e-7; };
  const auto ends = boost::math::tools::toms748_solve(f, a, b, fa, fb, near, calls);
  return (ends.first + ends.second) / 2;
}

Interval profile(const LinearModel& model, const Coordinates& coordinates, const Maximum& best, std::size_t at,
                 double rise) {
  const auto excess = [&](double spread) {
    std::vector<double> x = best.x;
    x[at] = spread;
    return maximise(model, coordinates, std::move(x), at).value - best.value - rise;
  };
  const double centre = best.x[at];
  Interval result{0, std::numeric_limits<double>::infinity()};
  if (centre > 0)
    if (const double zero = excess(0); zero > 0) result.lower = crossing(excess, 0, centre, zero, -rise);
  double low = centre, before = -rise, high = std::max(1.5 * centre, 0.02);
  while (high <= widest_spread) {
    if (const double value = excess(high); value > 0) {
      result.upper = crossing(excess, low, high, before, value);
      break;
    } else {
      low = high;
      before = value;
    }
    high *= 2;
  }
  return result;
}

}  // namespace

std::vector<Spread> spreads(const Cohort& cohort, const Form& form, const Alternation& fit, double confidence) {
  const Coordinates coordinates(cohort, form.within, form.between);
  const LinearModel model(cohort, form.design, fit.expansions, form.likelihood);
  const auto all = coordinates.spreads();
  std::vector<Spread> result(all.size());
  const double rise = confidence > 0 ? numerics::chi_squared_quantile(confidence, 1) : 0;
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
    const double scale = cohort.parameters[all[k].parameter].scale, value = fit.maximum.x[all[k].coordinate];
    result[k] = {
        all[k].parameter, all[k].between, value * scale, {0, std::numeric_limits<double>::infinity()}, value == 0};
    if (confidence <= 0) return;
    result[k].interval = profile(model, coordinates, fit.maximum, all[k].coordinate, rise);
    result[k].interval.lower *= scale;
    result[k].interval.upper *= scale;
  });
  return result;
}

}  // namespace tunica::population
