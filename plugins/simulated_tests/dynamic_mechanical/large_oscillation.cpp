// SPDX-License-Identifier: Apache-2.0
#include "large_oscillation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tunica/detail/vector_math.hpp"

namespace tunica::dynamic_mechanical {
namespace {

using Complex = std::complex<double>;

constexpr int newton_iterations = 40;
constexpr double last_step = 1e-7;  ///< of y, taken to first order
constexpr int most_cycles = 60;
constexpr double alike = 1e-10;     ///< moduli of two cycles, relative
constexpr double rounding = 1e-14;  ///< of a cycle; the state has it over what a cycle forgets
constexpr double most_alike = 1e-6;
constexpr double never = 1e-10;      ///< a part of the state that a cycle forgets, at least; less is nothing
constexpr double one_sided = 0.1;    ///< slopes up and down of a running maximum differ by 1
constexpr double state_part = 1e-4;  ///< of differences by the state, relative; branches are linear in it

}  // namespace

/// Notes why there are no moduli; false, which callers hand on.
bool LargeOscillation::fail(std::optional<std::size_t> row, std::string why) {
  failed_row_ = row;
  failure_ = std::move(why);
  return false;
}

/// C of row i at its y.
void LargeOscillation::place(std::size_t n, std::size_t i, double strain) {
  const auto component = [&](std::size_t c) -> double& { return C_[c * n + i]; };
  for (std::size_t c = 0; c < 6; ++c) component(c) = c < 3 ? 1 : 0;
  if (specimen_.shear) {
    component(specimen_.normal) = 1 + strain * strain;
    component(specimen_.sheared()) = strain;
    return;
  }
  component(specimen_.along) = strain * strain;
  component(specimen_.normal) = std::exp(y_[i]);
  component(specimen_.third()) = 1 / (strain * strain * component(specimen_.normal));
}

/// From the state before to the strain at this phase: the nominal stress of each row, and the state after.
bool LargeOscillation::step(std::span<const Row> rows, std::size_t per_cycle, double sine) {
  const std::size_t n = rows.size(), m = model_.describe().history_size;
  for (std::size_t i = 0; i < n; ++i) time_[i] = rows[i].period / static_cast<double>(per_cycle);
  const std::span<const double> time = m > 0 ? std::span<const double>(time_) : std::span<const double>();
  std::size_t slowest = 0;
  for (int k = 0; k < newton_iterations; ++k) {
    for (std::size_t i = 0; i < n; ++i) place(n, i, rows[i].centre + rows[i].amplitude * sine);
    const Status status = model_.evaluate({n, C_, parameters_, time, state_}, {{}, stress_, tangent_, {}, after_});
    if (!status.ok()) return fail(std::nullopt, status.reason());
    double largest = 0;
    slowest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double strain = rows[i].centre + rows[i].amplitude * sine;
      Tensor S, C;
      for (std::size_t c = 0; c < 6; ++c) {
        S[c] = stress_[c * n + i];
        C[c] = C_[c * n + i];
      }
      if (!detail::all_finite(S.data(), S.size())) return fail(i, "the stress is not finite");
      if (specimen_.shear) {
        nominal_[i] = S[specimen_.sheared()] + strain * S[specimen_.normal];
        continue;
      }
      std::array<double, 36> tangent;
      for (std::size_t c = 0; c < 36; ++c) tangent[c] = tangent_[c * n + i];
      Tensor by_y{};
      by_y[specimen_.normal] = C[specimen_.normal];
      by_y[specimen_.third()] = -C[specimen_.third()];
      const StripSlopes<double> at(specimen_, S, C, Tensor{}, SmallOscillation::change(tangent, by_y));
      const double move = -at.r / at.r_y;
      if (!(at.r_y > 0) || !std::isfinite(move)) return fail(i, "no lateral equilibrium along the cycle");
      nominal_[i] = (at.stress + at.stress_y * move) / strain;
      y_[i] += std::clamp(move, -0.6, 0.6);
      if (std::abs(move) > largest) slowest = i;
      largest = std::max(largest, std::abs(move));
    }
    if (largest > last_step) continue;
    std::swap(state_, after_);
    return true;
  }
  return fail(slowest, "no lateral equilibrium along the cycle");
}

/// One cycle from the state at its beginning. `guess`: y of the cycle before at each phase, or empty.
bool LargeOscillation::cycle(std::span<const Row> rows, std::size_t per_cycle, std::vector<double>& guess,
                             std::span<Complex> found) {
  const std::size_t n = rows.size();
  const bool first = guess.empty();
  guess.resize(n * per_cycle);
  std::fill(found.begin(), found.end(), Complex());
  for (std::size_t k = 1; k <= per_cycle; ++k) {
    const double phase = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(per_cycle);
    double* const here = guess.data() + n * (k - 1);
    if (!first) std::copy_n(here, n, y_.data());
    if (!step(rows, per_cycle, std::sin(phase))) return false;
    std::copy_n(y_.data(), n, here);
    const Complex weight(std::sin(phase), std::cos(phase));
    for (std::size_t i = 0; i < n; ++i)
      found[i] += weight * (nominal_[i] * 2 / (static_cast<double>(per_cycle) * rows[i].amplitude));
  }
  return true;
}

/// What one period at rest leaves of a change of the state: P. Of branches it is what a cycle leaves, whatever its
/// path. A running maximum, as the largest load so far, keeps a change upwards and undoes one downwards. It takes what
/// a cycle leaves, and so does what no cycle forgets.
bool LargeOscillation::forget(std::span<const Row> rows) {
  const std::size_t m = model_.describe().history_size, n = 2 * m + 1;  // up and down in each, and as it is
  left_.clear();
  grows_.clear();
  alike_.clear();
  if (m == 0) return true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    std::vector<double> C(6 * n), state(m * n), stress(6 * n), after(m * n), moved(m);
    const std::vector<double> time(n, row.period);
    double scale = 0;
    for (const double s : row.state) scale = std::max(scale, std::abs(s));
    if (scale == 0) scale = 1;
    for (std::size_t c = 0; c < 6; ++c) std::fill_n(C.begin() + static_cast<std::ptrdiff_t>(c * n), n, row.C[c]);
    for (std::size_t k = 0; k < m; ++k) {
      std::fill_n(state.begin() + static_cast<std::ptrdiff_t>(k * n), n, row.state[k]);
      moved[k] = state_part * std::max(std::abs(row.state[k]), scale);
      state[k * n + 2 * k] += moved[k];
      state[k * n + 2 * k + 1] -= moved[k];
    }
    const Status status = model_.evaluate({n, C, parameters_, time, state}, {{}, stress, {}, {}, after});
    if (!status.ok()) return fail(i, status.reason());
    if (!detail::all_finite(after.data(), after.size())) return fail(i, "the state of the model is not finite");
    Eigen::MatrixXd kept = Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(m));
    for (std::size_t c = 0; c < m; ++c)
      for (std::size_t k = 0; k < m; ++k)
        kept(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(k)) -=
            (after[c * n + 2 * k] - after[c * n + 2 * k + 1]) / (2 * moved[k]);
    auto& grows = grows_.emplace_back(m, false);
    double least = 1;
    for (std::size_t k = 0; k < m; ++k) {
      const double at_rest = after[k * n + 2 * m], up = (after[k * n + 2 * k] - at_rest) / moved[k],
                   down = (at_rest - after[k * n + 2 * k + 1]) / moved[k];
      const auto row_of = static_cast<Eigen::Index>(k);
      const double lost = kept(row_of, row_of);
      grows[k] = std::abs(up - down) > one_sided || !(lost > never);
      if (!grows[k]) {
        least = std::min(least, lost);
        continue;
      }
      kept.row(row_of).setZero();
      kept(row_of, row_of) = 1;
    }
    alike_.push_back(std::min(alike + rounding / least, most_alike));
    left_.emplace_back(kept);
  }
  return true;
}

/// Newton's method for the state s that a cycle Φ(s) comes back to: s + (1 − P)⁻¹ (Φ(s) − s). A running maximum takes
/// Φ(s) itself. Cycles are compared after a step: slow branches hardly move from one to the next.
bool LargeOscillation::settled(std::span<const Row> rows, std::size_t per_cycle, std::span<Complex> found) {
  const std::size_t n = rows.size(), m = model_.describe().history_size;
  for (auto* const column : {&time_, &y_, &nominal_}) column->resize(n);
  for (auto* const column : {&C_, &stress_}) column->resize(6 * n);
  tangent_.resize(specimen_.shear ? 0 : 36 * n);
  for (auto* const column : {&state_, &after_}) column->resize(m * n);
  for (std::size_t i = 0; i < n; ++i) {
    y_[i] = rows[i].y;
    for (std::size_t c = 0; c < m; ++c) state_[c * n + i] = rows[i].state[c];
  }
  std::vector<double> guess;
  std::vector<Complex> before(n);
  // The first cycle ends what a first loading alone does.
  if (!cycle(rows, per_cycle, guess, found)) return false;
  if (m == 0) return true;
  for (int k = 0; k < most_cycles; ++k) {
    const std::vector<double> begin = state_;
    std::copy(found.begin(), found.end(), before.begin());
    if (!cycle(rows, per_cycle, guess, found)) return false;
    const auto apart = std::find_if(found.begin(), found.end(), [&](const Complex& now) {
      const auto i = static_cast<std::size_t>(&now - found.data());
      return !(std::abs(now - before[i]) <= alike_[i] * std::abs(now));
    });
    if (k > 0 && apart == found.end()) return true;
    if (apart != found.end()) failed_row_ = static_cast<std::size_t>(apart - found.begin());
    for (std::size_t i = 0; i < n; ++i) {
      Eigen::VectorXd change(static_cast<Eigen::Index>(m));
      for (std::size_t c = 0; c < m; ++c)
        change[static_cast<Eigen::Index>(c)] = grows_[i][c] ? 0 : state_[c * n + i] - begin[c * n + i];
      const Eigen::VectorXd move = left_[i].solve(change);
      for (std::size_t c = 0; c < m; ++c)
        if (!grows_[i][c]) state_[c * n + i] = begin[c * n + i] + move[static_cast<Eigen::Index>(c)];
    }
  }
  return fail(failed_row_, "its cycles do not settle");
}

/// What steps make of a small oscillation is known, and taken off; the rest falls with their square.
bool LargeOscillation::moduli(std::span<const Row> rows, std::span<Complex> found) {
  const std::size_t n = rows.size();
  std::vector<Complex> coarse(n);
  if (!forget(rows) || !settled(rows, steps, coarse) || !settled(rows, 2 * steps, found)) return false;
  for (std::size_t i = 0; i < n; ++i) {
    coarse[i] -= rows[i].excess[0];
    found[i] -= rows[i].excess[1];
    found[i] += (found[i] - coarse[i]) / 3.0;
  }
  return true;
}

}  // namespace tunica::dynamic_mechanical
