// SPDX-License-Identifier: Apache-2.0
#include "search/correction.hpp"

#include <cmath>

namespace tunica::search {

double objective_of(std::span<const ResidualBlock> blocks, std::span<const double> residuals) {
  constexpr double epsilon = Problem::root_smoothing;
  double total = 0;
  for (const ResidualBlock& block : blocks) {
    double sum = 0;
    for (const double residual : residuals.subspan(block.offset, block.size)) sum += residual * residual;
    const bool root = block.loss == ResidualBlock::Loss::root;
    total += block.weight * (root ? std::sqrt(sum + epsilon * epsilon) - epsilon : sum);
  }
  return total;
}

double Correction::apply(std::span<const double> x, std::span<const ResidualBlock> blocks, std::span<double> residuals,
                         std::span<double> jacobian) const {
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    residuals[i] += offset[i];
    for (std::size_t j = 0; j < n && !slope.empty(); ++j) {
      const double width = upper[j] - lower[j];
      residuals[i] += slope[i * n + j] * (lower[j] + width * x[j] - centre[j]);
      if (!jacobian.empty()) jacobian[i * n + j] += slope[i * n + j] * width;
    }
  }
  return objective_of(blocks, residuals);
}

}  // namespace tunica::search
