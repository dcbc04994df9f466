// SPDX-License-Identifier: Apache-2.0
#include "small_oscillation.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace tunica::dynamic_mechanical {
namespace {

constexpr double long_ago = 1e30;     ///< s: whatever relaxes has done so
constexpr double strain_step = 1e-3;  ///< of differences by C
constexpr double state_step = 1e-4;   ///< of differences by the state, relative; branches are linear in it
/// Differences by C are those of four points, with errors of the fourth power: slow branches magnify rounding by
/// 1/part.
constexpr std::array shifts{1.0, -1.0, 2.0, -2.0};

/// Slopes on both sides that differ by more than this part of them are two; smooth ones differ by the third power of
/// the step.
constexpr double kink = 1e-3;

/// Whether the stress bends at `at`: `n` points in `stress`, those of each direction from `first` on, in the order of
/// `shifts`. With three points on each side the slopes are (4 f₁ − f₂ − 3 f₀)/2h and (3 f₀ − 4 f₋₁ + f₋₂)/2h.
bool bends(const Tensor& at, std::span<const double> stress, std::size_t n, std::size_t first, std::size_t directions) {
  double apart = 0, size = 0;
  for (std::size_t c = 0; c < 6; ++c) {
    size = std::max(size, 2 * strain_step * std::abs(at[c]));
    for (std::size_t k = 0; k < directions; ++k) {
      const double* const f = stress.data() + c * n + first + shifts.size() * k;
      const double ahead = 4 * f[0] - f[2] - 3 * at[c], behind = 3 * at[c] - 4 * f[1] + f[3];
      apart = std::max(apart, std::abs(ahead - behind));
      size = std::max({size, std::abs(ahead), std::abs(behind)});
    }
  }
  return apart > kink * size;
}

bool finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

/// The components of the state that the directions move, at once or through others: shear leaves those along the axes
/// alone, and the reverse. Unreached entries are exactly 0.
template <class ByStrain, class ByState>
std::vector<std::size_t> reached(std::size_t m, std::size_t d, const ByStrain& Q, const ByState& P) {
  std::vector<bool> is(m, false);
  std::vector<std::size_t> list;
  const auto add = [&](std::size_t i) {
    if (!is[i]) list.push_back(i);
    is[i] = true;
  };
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < d; ++k)
      if (Q(i, k) != 0) add(i);
  for (std::size_t next = 0; next < list.size(); ++next)
    for (std::size_t i = 0; i < m; ++i)
      if (!is[i] && P(i, list[next]) != 0) add(i);
  return list;
}

}  // namespace

Tensor SmallOscillation::change(const std::array<double, 36>& tangent, const Tensor& dC) {
  Tensor dS{};
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = 0; b < 6; ++b) dS[a] += (b < 3 ? 0.5 : 1.0) * tangent[6 * a + b] * dC[b];
  return dS;
}

bool SmallOscillation::fails(const Status& status) const {
  if (status.ok()) return false;
  failure_ = status.reason();
  return true;
}

bool SmallOscillation::settle(const Tensor& C) {
  C_ = C;
  const std::size_t m = model_.describe().history_size;
  state_.assign(m, 0.0);
  if (fails(model_.evaluate({1, C_, parameters_, {}, {}}, {{}, stress_, tangent_, {}, {}}))) return false;
  if (m > 0) {
    Tensor unused{};
    if (fails(model_.evaluate({1, C_, parameters_, {&long_ago, 1}, {}}, {{}, unused, {}, {}, state_}))) return false;
  }
  return finite(stress_) && finite(tangent_) && finite(state_);
}

/// Fibres that only pull bend the elastic curve as well, where they begin to.
bool SmallOscillation::bends_without_memory(std::span<const double> C, std::size_t first, std::size_t count) const {
  std::vector<double> stress(C.size());
  const std::size_t n = C.size() / 6;
  return !model_.evaluate({n, C, parameters_, {}, {}}, {{}, stress, {}, {}, {}}).ok() ||
         bends(stress_, stress, n, first, count);
}

bool SmallOscillation::respond(double omega, std::span<const Tensor> directions, std::span<ComplexTensor> changes,
                               double part) const {
  const std::size_t m = state_.size(), d = directions.size();
  two_slopes_ = false;
  if (m == 0) {
    for (std::size_t k = 0; k < d; ++k) {
      const Tensor dS = slow_change(directions[k]);
      std::copy(dS.begin(), dS.end(), changes[k].begin());
    }
    return true;
  }
  const double dt = part / omega;
  Tensor at{};
  std::array<double, 36> tangent{};
  if (fails(model_.evaluate({1, C_, parameters_, {&dt, 1}, state_}, {{}, at, tangent, {}, {}}))) return false;

  // Two points a component of the state, then four a direction.
  const std::size_t n = 2 * m + shifts.size() * d;
  std::vector<double> C(6 * n), state(m * n), stress(6 * n), after(m * n), steps(m);
  const std::vector<double> time(n, dt);
  for (std::size_t c = 0; c < 6; ++c) std::fill_n(C.begin() + static_cast<std::ptrdiff_t>(c * n), n, C_[c]);
  for (std::size_t c = 0; c < m; ++c) std::fill_n(state.begin() + static_cast<std::ptrdiff_t>(c * n), n, state_[c]);
  double scale = 0;
  for (const double s : stress_) scale = std::max(scale, std::abs(s));
  if (scale == 0) scale = 1;
  for (std::size_t k = 0; k < m; ++k) {
    steps[k] = state_step * std::max(std::abs(state_[k]), scale);
    state[k * n + 2 * k] += steps[k];
    state[k * n + 2 * k + 1] -= steps[k];
  }
  for (std::size_t k = 0; k < d; ++k)
    for (std::size_t c = 0; c < 6; ++c)
      for (std::size_t q = 0; q < shifts.size(); ++q)
        C[c * n + 2 * m + shifts.size() * k + q] += shifts[q] * strain_step * directions[k][c];
  if (fails(model_.evaluate({n, C, parameters_, time, state}, {{}, stress, {}, {}, after}))) return false;
  if (!finite(stress) || !finite(after) || !finite(tangent)) return false;
  two_slopes_ = bends(at, stress, n, 2 * m, d) && !bends_without_memory(C, 2 * m, d);
  if (two_slopes_) return false;

  const auto by_state = [&](const std::vector<double>& of, std::size_t component, std::size_t k) {
    return (of[component * n + 2 * k] - of[component * n + 2 * k + 1]) / (2 * steps[k]);
  };
  const auto by_strain = [&](std::size_t component, std::size_t k) {
    const double* const f = after.data() + component * n + 2 * m + shifts.size() * k;
    return (8 * (f[0] - f[1]) - (f[2] - f[3])) / (12 * strain_step);
  };
  const std::vector<std::size_t> moved =
      reached(m, d, by_strain, [&](std::size_t i, std::size_t k) { return by_state(after, i, k); });
  const auto size = static_cast<Eigen::Index>(moved.size());
  Eigen::MatrixXcd system(size, size), Q(size, static_cast<Eigen::Index>(d));
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::size_t row = moved[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < size; ++k) system(i, k) = -by_state(after, row, moved[static_cast<std::size_t>(k)]);
    for (std::size_t k = 0; k < d; ++k) Q(i, static_cast<Eigen::Index>(k)) = by_strain(row, k);
  }
  // z − 1 without cancellation, beside 1 − P.
  const double half = std::sin(part / 2);
  system.diagonal().array() += 1.0;
  system.diagonal().array() += std::complex<double>(-2 * half * half, std::sin(part));
  const Eigen::MatrixXcd s = system.partialPivLu().solve(Q);
  for (std::size_t k = 0; k < d; ++k) {
    const Tensor T = change(tangent, directions[k]);
    for (std::size_t c = 0; c < 6; ++c) {
      changes[k][c] = T[c];
      for (Eigen::Index i = 0; i < size; ++i)
        changes[k][c] += by_state(stress, c, moved[static_cast<std::size_t>(i)]) * s(i, static_cast<Eigen::Index>(k));
    }
  }
  return true;
}

}  // namespace tunica::dynamic_mechanical
