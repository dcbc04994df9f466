// SPDX-License-Identifier: Apache-2.0
#include "scaled_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tunica/detail/solve_strip.hpp"
#include "tunica/detail/vector_math.hpp"

namespace tunica::uniaxial {
namespace {

/// Scratch of one thread; the strip at rest comes last in what the model answers.
struct Scaling {
  std::vector<double> y, c, energy, gradient, gradient_dp, energy_dp;
  std::vector<double> work, stress, eta, by_energy, by_largest, by_own;
  std::vector<std::size_t> largest;
};
Scaling& thread_scaling() {
  thread_local Scaling instance;
  return instance;
}

/// Squared stretches of all rows, and energies with the largest stress there.
Status evaluate_energies(const Strip& strip, const Model& elastic, std::span<const double> parameters,
                         std::span<const double> stretch, std::span<double> u, bool derivatives, Scaling& m) {
  const std::size_t n = stretch.size(), points = n + 1;
  const auto c = room(m.c, 3 * points), energy = room(m.energy, points), g = room(m.gradient, 3 * points);
  const std::size_t wanted = derivatives ? points * parameters.size() : 0;
  for (std::size_t a = 0; a < 3; ++a) c[a * points + n] = 1;
  detail::vectorised([n, l = stretch.data(), y = m.y.data(), u = u.data(), c1 = c.data() + strip.loaded * points,
                      c2 = c.data() + strip.transverse * points, c3 = c.data() + 2 * points] {
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) {
      u[i] = detail::lane_exp(y[i]);
      c1[i] = l[i] * l[i];
      c2[i] = u[i];
      c3[i] = 1 / (c1[i] * u[i]);
    }
  });
  if (Status status = elastic.evaluate_axes(
          {points, c, parameters}, {energy, g, {}, room(m.gradient_dp, 3 * wanted), room(m.energy_dp, wanted)});
      !status.ok())
    return status;
  detail::vectorised(
      [n, points, e = energy.data(), g = g.data(), work = room(m.work, n).data(), stress = room(m.stress, n).data()] {
        TUNICA_LANES
        for (std::size_t i = 0; i < n; ++i) {
          const double first = std::abs(g[i]), second = std::abs(g[points + i]), third = std::abs(g[2 * points + i]);
          const double larger = first > second ? first : second;
          work[i] = e[i] - e[n];
          stress[i] = 2 * (larger > third ? larger : third);
        }
      });
  return {};
}

/// Derivatives by all parameters, from those of the elastic strip and of the energy.
void add_derivatives(std::size_t n, std::size_t elastic, std::size_t own, std::span<double> stress_dp,
                     const double* stress, const Scaling& m) {
  const std::size_t points = n + 1;
  for (std::size_t j = 0; j < elastic; ++j)
    detail::vectorised([n, stress, out = stress_dp.data() + j * n, e = m.energy_dp.data() + j * points,
                        eta = m.eta.data(), by = m.by_energy.data(), by_largest = m.by_largest.data(),
                        largest = m.largest.data()] {
      for (std::size_t i = 0; i < n; ++i)
        out[i] = eta[i] * out[i] + stress[i] * (by[i] * (e[i] - e[n]) + by_largest[i] * (e[largest[i]] - e[n]));
    });
  for (std::size_t k = 0; k < own; ++k)
    for (std::size_t i = 0; i < n; ++i) stress_dp[(elastic + k) * n + i] = stress[i] * m.by_own[k * n + i];
}

}  // namespace

Status scale_elastic(const Strip& strip, const TestInput& input, std::span<const double> stretch,
                     const free_strip::Start& start, const EnergyScaledModel& model, free_strip::Scratch& scratch,
                     const PathRows& rows, bool parameters) {
  Scaling& m = thread_scaling();
  const Model& elastic = input.model.elastic();
  const std::size_t n = stretch.size(), count = elastic.describe().parameters.size();
  const std::size_t own = input.model_parameters.size() - count, derivatives = parameters ? n * count : 0;
  StripPath path{.loaded = strip.loaded,
                 .parameters = input.model_parameters.first(count),
                 .stretch = stretch,
                 .stress = rows.stress,
                 .lateral = room(m.y, n)};
  if (parameters) path.stress_dp = rows.stress_dp.first(derivatives);
  if (!rows.y_dp.empty()) path.lateral_dp = rows.y_dp.first(derivatives);
  if (input.abscissae.empty()) start.set(path);
  if (Status status = free_strip::solve(elastic, path, scratch); !status.ok()) return status;
  if (Status status = evaluate_energies(strip, elastic, path.parameters, stretch, rows.u, parameters, m); !status.ok())
    return status;
  if (m.largest.size() < n) m.largest.resize(n);
  const EnergyScaledModel::Factors factors{room(m.eta, n),
                                           room(m.by_energy, n),
                                           room(m.by_largest, n),
                                           {m.largest.data(), n},
                                           room(m.by_own, parameters ? n * own : 0)};
  // What a plugin leaves unwritten is no number.
  std::fill(factors.eta.begin(), factors.eta.end(), std::numeric_limits<double>::quiet_NaN());
  std::fill(factors.largest.begin(), factors.largest.end(), n);
  if (!model.scale_path({input.model_parameters, {m.work.data(), n}, {m.stress.data(), n}}, factors) ||
      std::any_of(factors.largest.begin(), factors.largest.end(), [n](std::size_t row) { return row > n; }))
    return Status::failed("uniaxial: the model does not say by what factors its elastic stress is multiplied");
  if (parameters) add_derivatives(n, count, own, rows.stress_dp, rows.stress.data(), m);
  if (!rows.y_dp.empty()) std::fill(rows.y_dp.begin() + static_cast<std::ptrdiff_t>(derivatives), rows.y_dp.end(), 0.0);
  for (std::size_t i = 0; i < n; ++i) rows.stress[i] *= m.eta[i];
  return {};
}

}  // namespace tunica::uniaxial
