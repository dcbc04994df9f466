// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "tunica/detail/free_strip.hpp"

/// The free strip of a material that does not tell its two lateral axes apart. There λ2 = λ3 = λ1^(−½) by symmetry, and
///
///     σ = 2 (c1 g1 − c3 g3)   at c = (λ1², 1/λ1, 1/λ1)
///
/// needs no iteration: it is finite wherever the energy is defined, whether or not the state is a minimum of W over
/// the lateral stretch.
namespace tunica::free_strip {

/// What the two lateral axes may differ by: rounding.
inline constexpr double alike = 1e-12;

/// Whether an invariant has no direction: it is made of I1 and I2 alone.
inline bool is_isotropic(const Invariant& x) { return x.fibre == 0 && x.normal == 0 && x.across == 0; }

/// What a model says of its own symmetry.
enum class Symmetry {
  isotropic,  ///< its parts depend on I1 and I2 alone
  other,      ///< some part has a direction
  unknown     ///< it has no parts
};

inline Symmetry symmetry_of_parts(const Model& model, std::span<const double> parameters) {
  const auto parts = model.parts();
  if (parts.empty()) return Symmetry::unknown;
  // Parts with a direction mostly come last.
  const bool isotropic = std::all_of(parts.rbegin(), parts.rend(), [parameters](const auto& part) {
    if (part->describe().active == EnergyPart::Active::fibre_stretched) return false;
    Invariant x;
    part->invariant(parameters, x, {});
    return is_isotropic(x);
  });
  return isotropic ? Symmetry::isotropic : Symmetry::other;
}

/// Whether the response of a model at λ2 = λ3 stays the same when these two axes change places, to second order, at
/// each of the stretches. One call asks for both orders, as the batches of an iteration do: where a plugin ends in it,
/// theirs is known to end too.
template <std::size_t n>
bool exchanges_lateral_axes(const Pull& pull, const std::array<double, n>& stretches) {
  const std::size_t l = pull.loaded, t = pull.transverse();
  std::array<double, 3 * n> c, g;
  std::array<double, 6 * n> h;
  for (std::size_t i = 0; i < n; ++i) {
    c[l * n + i] = stretches[i] * stretches[i];
    c[t * n + i] = c[2 * n + i] = 1 / stretches[i];
  }
  const auto same = [](double a, double b, double scale) { return std::abs(a - b) <= alike * scale; };
  const auto slope = [&g](std::size_t i) { return std::abs(g[i]) + std::abs(g[n + i]) + std::abs(g[2 * n + i]); };
  if (!pull.model.evaluate_axes({n, c, pull.parameters}, {{}, g, h, {}}).ok()) return false;
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(slope(i)) || !same(g[t * n + i], g[2 * n + i], slope(i))) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const auto bend = [&h, i](std::size_t a, std::size_t b) { return h[pair[a][b] * n + i]; };
    const double scale = std::abs(bend(l, l)) + std::abs(bend(t, t)) + std::abs(bend(2, 2)) +
                         (std::abs(bend(l, t)) + std::abs(bend(l, 2))) + slope(i) / c[t * n + i];
    if (!std::isfinite(scale) || !same(bend(t, t), bend(2, 2), scale) || !same(bend(l, t), bend(l, 2), scale))
      return false;
  }
  return true;
}

/// Whether symmetry gives the answer at these stretches: the parts say so or, where there are none, the response does,
/// at the outermost stretches and at one between. What is not seen to be symmetric is left to iteration.
inline bool is_symmetric(const Pull& pull, std::span<const double> stretch) {
  if (stretch.empty()) return false;
  const Symmetry said = symmetry_of_parts(pull.model, pull.parameters);
  if (said != Symmetry::unknown) return said == Symmetry::isotropic;
  const auto [low, high] = std::minmax_element(stretch.begin(), stretch.end());
  return exchanges_lateral_axes<3>(pull, {*high, *low, 0.9 * *low + 0.1 * *high + 0.01});
}

/// The answers of a strip where is_symmetric() holds, else false. A row whose stress is no number is lost.
inline bool solve_symmetric(const Pull& pull, const StripPath& path, Scratch& s, Status& status) {
  if (!is_symmetric(pull, path.stretch)) return false;
  const std::size_t n = path.stretch.size(), l = pull.loaded, t = pull.transverse();
  const bool along = !path.stress_by_l.empty(), by_parameters = !path.stress_dp.empty();
  const std::size_t parameters = by_parameters ? path.parameters.size() : 0;
  s.reserve(n, parameters);
  double* const c1 = s.c.data() + l * n;
  double* const c2 = s.c.data() + t * n;
  double* const c3 = s.c.data() + 2 * n;
  for (std::size_t i = 0; i < n; ++i) {
    c1[i] = path.stretch[i] * path.stretch[i];
    c2[i] = c3[i] = 1 / path.stretch[i];
  }
  if (status = pull.model.evaluate_axes({n, {s.c.data(), 3 * n}, path.parameters},
                                        {{},
                                         {s.gradient.data(), 3 * n},
                                         {s.hessian.data(), along ? 6 * n : 0},
                                         {s.gradient_dp.data(), 3 * n * parameters}});
      !status.ok())
    return true;
  const double* const g1 = s.gradient.data() + l * n;
  const double* const g3 = s.gradient.data() + 2 * n;
  const double* const g2 = s.gradient.data() + t * n;
  for (std::size_t i = 0; i < n; ++i) {
    s.stress[i] = 2 * (c1[i] * g1[i] - c3[i] * g3[i]);
    if (std::abs(g2[i] - g3[i]) > alike * (std::abs(g1[i]) + std::abs(g2[i]) + std::abs(g3[i]))) return false;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isfinite(s.stress[i])) continue;
    if (path.lost != nullptr) *path.lost = i;
    status = Status::failed(
        "the stress is no number: the stretch is beyond the limit of the model, or the energy overflows");
    return true;
  }
  std::copy_n(s.stress.data(), path.stress.size(), path.stress.data());
  for (std::size_t i = 0; i < path.lateral.size(); ++i) path.lateral[i] = -std::log(path.stretch[i]);
  // By l along the path: ∂c1/∂l = 2 c1, ∂c2/∂l = −c2, ∂c3/∂l = −c3.
  const auto h = [&s, n](std::size_t a, std::size_t b, std::size_t i) { return s.hessian[pair[a][b] * n + i]; };
  for (std::size_t i = 0; i < path.stress_by_l.size(); ++i) {
    const double g1_l = 2 * c1[i] * h(l, l, i) - c2[i] * (h(l, t, i) + h(l, 2, i));
    const double g3_l = 2 * c1[i] * h(l, 2, i) - c2[i] * (h(t, 2, i) + h(2, 2, i));
    path.stress_by_l[i] = 2 * (c1[i] * (2 * g1[i] + g1_l) + c3[i] * (g3[i] - g3_l));
  }
  std::fill(path.lateral_by_l.begin(), path.lateral_by_l.end(), -1.0);
  for (std::size_t j = 0; j < parameters; ++j) {
    const double* const gp1 = s.gradient_dp.data() + (3 * j + l) * n;
    const double* const gp3 = s.gradient_dp.data() + (3 * j + 2) * n;
    double* const column = path.stress_dp.data() + j * n;
    for (std::size_t i = 0; i < n; ++i) column[i] = 2 * (c1[i] * gp1[i] - c3[i] * gp3[i]);
  }
  std::fill(path.lateral_dp.begin(), path.lateral_dp.end(), 0.0);
  status = {};
  return true;
}

}  // namespace tunica::free_strip
