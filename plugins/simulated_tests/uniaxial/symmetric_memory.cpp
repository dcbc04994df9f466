// SPDX-License-Identifier: Apache-2.0
#include "symmetric_memory.hpp"

#include <algorithm>
#include <vector>

#include "relaxation.hpp"
#include "tunica/detail/symmetric_strip.hpp"
#include "tunica/detail/vector_math.hpp"

namespace tunica::uniaxial {
namespace {

/// Of all rows; the strip at rest comes last in those of the elastic response.
struct Columns {
  std::vector<double> stretch, stress, stress_dp;              ///< of the elastic response
  std::vector<double> inverse_c1, inverse_c3, first, through;  ///< 1/c1, 1/c3, ⅔ c1, ⅓ c3
  Relaxation relaxation;
};
Columns& thread_columns() {
  thread_local Columns instance;
  return instance;
}

/// Adds g (⅔ c1 M[s/c1] + ⅓ c3 M[s/c3]) of a column s; s[n] is at rest.
void add_memory(const Columns& m, std::size_t n, const double* s, double g, double* out) {
  const Relaxation& r = m.relaxation;
  detail::vectorised([n, s, g, out, decay = r.decay.data(), taken = r.taken.data(), c1 = m.inverse_c1.data(),
                      c3 = m.inverse_c3.data(), w1 = m.first.data(), w3 = m.through.data()] {
    double h1 = 0, h3 = 0, before1 = s[n], before3 = s[n];
    for (std::size_t i = 0; i < n; ++i) {
      const double now1 = s[i] * c1[i], now3 = s[i] * c3[i];
      h1 = decay[i] * h1 + taken[i] * (now1 - before1);
      h3 = decay[i] * h3 + taken[i] * (now3 - before3);
      out[i] += g * (w1[i] * h1 + w3[i] * h3);
      before1 = now1;
      before3 = now3;
    }
  });
}

/// The same of the stress, with its derivatives by g and by τ.
void add_memory(const Columns& m, std::size_t n, double g, double* out, double* by_g, double* by_tau) {
  const Relaxation& r = m.relaxation;
  detail::vectorised([=, s = m.stress.data(), decay = r.decay.data(), taken = r.taken.data(), by = r.by_tau.data(),
                      of_h = r.by_tau_of_h.data(), c1 = m.inverse_c1.data(), c3 = m.inverse_c3.data(),
                      w1 = m.first.data(), w3 = m.through.data()] {
    double h1 = 0, h3 = 0, t1 = 0, t3 = 0, before1 = s[n], before3 = s[n];
    for (std::size_t i = 0; i < n; ++i) {
      const double now1 = s[i] * c1[i], now3 = s[i] * c3[i], change1 = now1 - before1, change3 = now3 - before3;
      t1 = decay[i] * t1 + (by[i] * change1 + of_h[i] * h1);
      t3 = decay[i] * t3 + (by[i] * change3 + of_h[i] * h3);
      h1 = decay[i] * h1 + taken[i] * change1;
      h3 = decay[i] * h3 + taken[i] * change3;
      const double memory = w1[i] * h1 + w3[i] * h3;
      out[i] += g * memory;
      by_g[i] = memory;
      by_tau[i] = g * (w1[i] * t1 + w3[i] * t3);
      before1 = now1;
      before3 = now3;
    }
  });
}

}  // namespace

bool remember_symmetric(const Strip& strip, const TestInput& input, std::span<const double> stretch,
                        std::span<const MaxwellModel::Branch> branches, free_strip::Scratch& scratch,
                        std::span<double> stress, std::span<double> stress_dp, Status& status) {
  const Model& elastic = input.model.elastic();
  const std::size_t n = stretch.size(), own = elastic.describe().parameters.size(), points = n + 1;
  Columns& m = thread_columns();
  for (auto* const column : {&m.stretch, &m.stress, &m.inverse_c1, &m.inverse_c3, &m.first, &m.through})
    if (column->size() < points) column->resize(points);
  std::copy(stretch.begin(), stretch.end(), m.stretch.begin());
  m.stretch[n] = 1;
  const std::size_t derivatives = stress_dp.empty() ? 0 : points * own;
  if (m.stress_dp.size() < derivatives) m.stress_dp.resize(derivatives);
  const std::span<const double> parameters = input.model_parameters.first(own);
  const StripPath path{.loaded = strip.loaded,
                       .parameters = parameters,
                       .stretch = {m.stretch.data(), points},
                       .stress = {m.stress.data(), points},
                       .stress_dp = {m.stress_dp.data(), derivatives}};
  if (!free_strip::solve_symmetric({elastic, parameters, strip.loaded}, path, scratch, status)) return false;
  if (!status.ok()) return true;
  detail::vectorised([n, l = m.stretch.data(), c1 = m.inverse_c1.data(), c3 = m.inverse_c3.data(), w1 = m.first.data(),
                      w3 = m.through.data()] {
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) {
      const double inverse = 1 / l[i];
      c1[i] = inverse * inverse;
      c3[i] = l[i];
      w1[i] = 2.0 / 3 * l[i] * l[i];
      w3[i] = 1.0 / 3 * inverse;
    }
  });
  std::copy_n(m.stress.data(), n, stress.data());
  if (!stress_dp.empty()) {
    for (std::size_t j = 0; j < own; ++j) std::copy_n(m.stress_dp.data() + j * points, n, stress_dp.data() + j * n);
    std::fill(stress_dp.begin() + static_cast<std::ptrdiff_t>(own * n), stress_dp.end(), 0.0);
  }
  for (const MaxwellModel::Branch& branch : branches) {
    const double g = input.model_parameters[branch.g];
    m.relaxation.set(strip.time, 0, n, input.model_parameters[branch.tau]);
    if (stress_dp.empty()) {
      add_memory(m, n, m.stress.data(), g, stress.data());
      continue;
    }
    add_memory(m, n, g, stress.data(), stress_dp.data() + branch.g * n, stress_dp.data() + branch.tau * n);
    for (std::size_t j = 0; j < own; ++j)
      add_memory(m, n, m.stress_dp.data() + j * points, g, stress_dp.data() + j * n);
  }
  return true;
}

}  // namespace tunica::uniaxial
