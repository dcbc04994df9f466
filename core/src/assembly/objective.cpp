// SPDX-License-Identifier: Apache-2.0
#include "assembly/objective.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tunica/error.hpp"

namespace tunica::assembly {

void scale_residuals(ChannelObjective& fitted, experiment::ObjectiveType objective, double weight,
                     const NoiseModel* noise, const std::string& where) {
  using experiment::ObjectiveType;
  const std::size_t n = fitted.rows.size();
  constexpr double largest = 1e100;  // squares of what is larger overflow in sums
  for (const double value : fitted.measured)
    if (!(std::abs(value) <= largest))
      throw InputError(
          fmt::format("{}: a row measures {}, and numbers beyond {} cannot be squared; check the unit of "
                      "the column, or leave the row out with \"rows\"",
                      where, value, largest));
  fitted.block.weight = weight;
  fitted.block.loss = ResidualBlock::Loss::quadratic;
  fitted.previous.clear();
  if (objective == ObjectiveType::sum_of_norms) {
    fitted.block.loss = ResidualBlock::Loss::root;
    fitted.own.assign(n, 1.0);
  } else if (objective == ObjectiveType::standardised_quadratic) {
    const auto [lowest, highest] = std::minmax_element(fitted.measured.begin(), fitted.measured.end());
    const double range = *highest - *lowest;
    if (!(range > 0)) {
      throw InputError(
          fmt::format("{}: all {} fitted rows measure {}, so 'standardised_quadratic' has no range to divide "
                      "by; fit more rows or choose another objective",
                      where, n, *lowest));
    }
    fitted.own.assign(n, 1 / std::sqrt(static_cast<double>(n) * range));
  } else {
    // Whitening of a first-order autoregression: (e_k/σ_k − φ e_{k−1}/σ_{k−1})/√(1 − φ²).
    fitted.own.resize(n);
    if (!noise->neighbour.empty()) fitted.previous.assign(n, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
      const double phi = noise->neighbour.empty() ? 0 : noise->neighbour[k];
      const double innovation = std::sqrt(1 - phi * phi);
      fitted.own[k] = 1 / (noise->sd[k] * innovation);
      if (k > 0 && phi != 0) fitted.previous[k] = phi / (noise->sd[k - 1] * innovation);
    }
  }
}

double channel_cost(const ChannelObjective& fitted, std::span<const double> measured,
                    std::span<const double> predictions, std::span<double> residuals) {
  const std::size_t n = fitted.rows.size(), offset = fitted.block.offset;
  const bool correlated = !fitted.previous.empty();
  double sum = 0, before = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double error = predictions[fitted.rows[k]] - measured[k];
    double residual = fitted.own[k] * error;
    if (correlated) {
      residual -= fitted.previous[k] * before;
      before = error;
    }
    if (!residuals.empty()) residuals[offset + k] = residual;
    sum += residual * residual;
  }
  if (fitted.block.loss == ResidualBlock::Loss::quadratic) return fitted.block.weight * sum;
  constexpr double epsilon = Problem::root_smoothing;
  return fitted.block.weight * (std::sqrt(sum + epsilon * epsilon) - epsilon);
}

}  // namespace tunica::assembly
