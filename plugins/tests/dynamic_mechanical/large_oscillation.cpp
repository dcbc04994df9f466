// SPDX-License-Identifier: Apache-2.0
#include "large_oscillation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/QR>

namespace tunica::dynamic_mechanical {
namespace {

using Complex = std::complex<double>;

constexpr int newton_iterations = 40;
constexpr double last_step = 1e-7;  ///< of y, taken to first order
constexpr std::size_t round = 5;    ///< cycles from which the limit is extrapolated
constexpr int rounds = 12;
constexpr double alike = 1e-9;  ///< moduli of two rounds, relative

/// The limit of s_0, s_1, …: Σ γ_j s_j with Σ γ_j = 1 and the least Σ γ_j (s_{j+1} − s_j). Each of them is one column.
Eigen::VectorXd limit_of(const Eigen::MatrixXd& s) {
  const Eigen::Index k = s.cols() - 2;
  const Eigen::MatrixXd first = s.middleCols(1, k + 1) - s.leftCols(k + 1);
  // γ = (1 − ξ_0, ξ_0 − ξ_1, …): s_0 + Σ ξ_j u_j, where u_0 + Σ ξ_j (u_{j+1} − u_j) is least.
  const Eigen::MatrixXd second = first.rightCols(k) - first.leftCols(k);
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> least;
  least.setThreshold(1e-12);
  const Eigen::VectorXd xi = least.compute(second).solve(-first.col(0));
  return s.col(0) + first.leftCols(k) * xi;
}

bool finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

bool LargeOscillation::fails(std::size_t row, std::string why) {
  failed_row_ = row;
  failure_ = std::move(why);
  return true;
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
bool LargeOscillation::step(std::span<const Row> rows, std::size_t steps, double sine) {
  const std::size_t n = rows.size(), m = model_.describe().history_size;
  for (std::size_t i = 0; i < n; ++i) time_[i] = rows[i].period / static_cast<double>(steps);
  const std::span<const double> time = m > 0 ? std::span<const double>(time_) : std::span<const double>();
  for (int k = 0; k < newton_iterations; ++k) {
    for (std::size_t i = 0; i < n; ++i) place(n, i, rows[i].centre + rows[i].amplitude * sine);
    const Status status = model_.evaluate({n, C_, parameters_, time, state_}, {{}, stress_, tangent_, {}, after_});
    if (!status.ok()) return !fails(0, status.reason());
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double strain = rows[i].centre + rows[i].amplitude * sine;
      Tensor S, C;
      for (std::size_t c = 0; c < 6; ++c) {
        S[c] = stress_[c * n + i];
        C[c] = C_[c * n + i];
      }
      if (!finite(S)) return !fails(i, "the stress is not finite");
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
      if (!(at.r_y > 0) || !std::isfinite(move)) return !fails(i, "no lateral equilibrium along the cycle");
      nominal_[i] = (at.stress + at.stress_y * move) / strain;
      y_[i] += std::clamp(move, -0.6, 0.6);
      largest = std::max(largest, std::abs(move));
    }
    if (largest > last_step) continue;
    std::swap(state_, after_);
    return true;
  }
  return !fails(0, "no lateral equilibrium along the cycle");
}

/// One cycle from the state at its beginning. `guess`: y of the cycle before at each phase, or empty.
bool LargeOscillation::cycle(std::span<const Row> rows, std::size_t steps, std::vector<double>& guess,
                             std::span<Complex> found) {
  const std::size_t n = rows.size();
  const bool first = guess.empty();
  guess.resize(n * steps);
  std::fill(found.begin(), found.end(), Complex());
  for (std::size_t k = 1; k <= steps; ++k) {
    const double phase = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(steps);
    double* const here = guess.data() + n * (k - 1);
    if (!first) std::copy_n(here, n, y_.data());
    if (!step(rows, steps, std::sin(phase))) return false;
    std::copy_n(y_.data(), n, here);
    const Complex weight(std::sin(phase), std::cos(phase));
    for (std::size_t i = 0; i < n; ++i)
      found[i] += weight * (nominal_[i] * 2 / (static_cast<double>(steps) * rows[i].amplitude));
  }
  return true;
}

/// M* once it stays from round to round.
bool LargeOscillation::settled(std::span<const Row> rows, std::size_t steps, std::span<Complex> found) {
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
  if (!cycle(rows, steps, guess, found)) return false;
  if (m == 0) return true;
  std::vector<Eigen::MatrixXd> states(n, Eigen::MatrixXd(m, round + 1));
  for (int k = 0; k < rounds; ++k) {
    for (std::size_t j = 0; j <= round; ++j) {
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < m; ++c)
          states[i](static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(j)) = state_[c * n + i];
      if (j < round && !cycle(rows, steps, guess, found)) return false;
    }
    std::size_t apart = 0;
    for (std::size_t i = 0; i < n; ++i)
      if (apart == i && std::abs(found[i] - before[i]) <= alike * std::abs(found[i])) ++apart;
    if (apart == n) return true;
    failed_row_ = apart;
    std::copy(found.begin(), found.end(), before.begin());
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::VectorXd limit = limit_of(states[i]);
      if (!limit.allFinite()) continue;
      for (std::size_t c = 0; c < m; ++c) state_[c * n + i] = limit[static_cast<Eigen::Index>(c)];
    }
  }
  return !fails(failed_row_, "its cycles do not settle");
}

bool LargeOscillation::moduli(std::span<const Row> rows, std::span<Complex> found) {
  std::vector<Complex> coarse(rows.size());
  if (!settled(rows, steps, coarse) || !settled(rows, 2 * steps, found)) return false;
  for (std::size_t i = 0; i < rows.size(); ++i) found[i] += (found[i] - coarse[i]) / 3.0;
  return true;
}

}  // namespace tunica::dynamic_mechanical
