// SPDX-License-Identifier: Apache-2.0
#include "comparison/information.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tunica::comparison {

std::optional<Information> information(const assembly::Assembly& assembly, experiment::ObjectiveType objective,
                                       std::span<const double> free) {
  if (objective != experiment::ObjectiveType::least_squares) return {};
  for (const auto& parameter : assembly.layout().parameters)
    if (parameter.prior) return {};
  std::vector<double> residuals(assembly.layout().residual_count);
  const auto workspace = assembly.evaluator().make_workspace();
  double value = 0;
  if (assembly.evaluator().evaluate(free, value, {}, residuals, {}, *workspace).kind() == Status::Kind::failed)
    return {};

  double deviance = 0, rows = 0, unstated_rows = 0, unstated_squares = 0;
  std::size_t parameters = free.size(), stated = 0, estimated = 0, block = 0;
  for (const auto& channel : assembly.layout().channels) {
    const auto count = static_cast<std::size_t>(std::count(channel.fitted.begin(), channel.fitted.end(), true));
    if (count == 0) continue;  // has no block
    const ResidualBlock& own = assembly.layout().blocks[block++];
    if (channel.weight == 0) continue;
    if (channel.weight != 1) return {};
    rows += static_cast<double>(count);
    double squares = 0;
    for (std::size_t k = 0; k < own.size; ++k) squares += residuals[own.offset + k] * residuals[own.offset + k];
    if (channel.sigma.stated()) {
      ++stated;
      deviance += squares;
    } else {
      ++estimated;
      unstated_rows += static_cast<double>(count);
      unstated_squares += squares;
    }
  }
  if (estimated > 0) {
    ++parameters;
    deviance += unstated_rows * std::log(unstated_squares / unstated_rows);
  }
  if (rows == 0 || !std::isfinite(deviance)) return {};
  const double k = static_cast<double>(parameters);
  Information result;
  if (rows > k + 1) result.aicc = deviance + 2 * k + 2 * k * (k + 1) / (rows - k - 1);
  result.bic = deviance + k * std::log(rows);
  result.noise = estimated == 0 ? Information::Noise::stated
                 : stated == 0  ? Information::Noise::estimated
                                : Information::Noise::mixed;
  return result;
}

}  // namespace tunica::comparison
