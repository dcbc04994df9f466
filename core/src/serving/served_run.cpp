// SPDX-License-Identifier: Apache-2.0
#include "serving/served_run.hpp"

#include <cmath>

#include <fmt/format.h>

#include "tunica/error.hpp"

namespace tunica::serving {
namespace {

/// ∂ρ/∂s of a block's loss, see Problem::root_smoothing.
double slope(const ResidualBlock& block, double squares) {
  constexpr double e = Problem::root_smoothing;
  return block.loss == ResidualBlock::Loss::quadratic ? 1 : 0.5 / std::sqrt(squares + e * e);
}

}  // namespace

std::string_view name_of(ServedRun::Function function) {
  return function == ServedRun::Function::objective   ? "objective"
         : function == ServedRun::Function::residuals ? "residuals"
                                                      : "predictions";
}

std::vector<std::size_t> ServedRun::output_sizes(Function function) const {
  if (function == Function::objective) return {1};
  if (function == Function::residuals) return {layout().residual_count};
  std::vector<std::size_t> sizes;
  for (const auto& channel : layout().channels) sizes.push_back(channel.count);
  return sizes;
}

void ServedRun::check(std::span<const double> parameters) const {
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const auto& parameter = layout().parameters[j];
    if (!(parameters[j] >= parameter.min && parameters[j] <= parameter.max))
      throw InputError(fmt::format("parameter '{}' is {}, outside its bounds {} … {} {}", parameter.name, parameters[j],
                                   parameter.min, parameter.max, parameter.unit));
  }
}

std::vector<std::vector<double>> ServedRun::values(Function function, std::span<const double> parameters) const {
  check(parameters);
  const auto workspace = assembly_.evaluator().make_workspace();
  if (function == Function::predictions) {
    std::vector<double> predictions(layout().prediction_count);
    const Status status = assembly_.evaluator().predict(parameters, predictions, {}, *workspace);
    if (!status.ok()) throw ModelFailure(status.reason());
    std::vector<std::vector<double>> outputs;
    for (const auto& channel : layout().channels) {
      const auto first = predictions.begin() + static_cast<std::ptrdiff_t>(channel.offset);
      outputs.emplace_back(first, first + static_cast<std::ptrdiff_t>(channel.count));
    }
    return outputs;
  }
  double objective = 0;
  std::vector<double> residuals(function == Function::residuals ? layout().residual_count : 0);
  const Status status = assembly_.evaluator().evaluate(parameters, objective, {}, residuals, {}, *workspace);
  if (status.kind() == Status::Kind::failed) throw ModelFailure(status.reason());
  if (function == Function::residuals) return {std::move(residuals)};
  return {{objective}};
}

std::vector<double> ServedRun::jacobian(Function function, std::size_t output,
                                        std::span<const double> parameters) const {
  check(parameters);
  const std::size_t n = input_size(), m = layout().residual_count;
  const auto workspace = assembly_.evaluator().make_workspace();
  if (function == Function::predictions) {
    std::vector<double> predictions(layout().prediction_count), all(predictions.size() * n);
    const Status status = assembly_.evaluator().predict(parameters, predictions, all, *workspace);
    if (!status.ok()) throw ModelFailure(status.reason());
    const auto& channel = layout().channels[output];
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(channel.offset * n);
    return {first, first + static_cast<std::ptrdiff_t>(channel.count * n)};
  }
  double objective = 0;
  std::vector<double> residuals(m), rows(m * n);
  const Status status = assembly_.evaluator().evaluate(parameters, objective, {}, residuals, rows, *workspace);
  if (status.kind() == Status::Kind::failed) throw ModelFailure(status.reason());
  if (function == Function::residuals) return rows;
  // ∂f/∂p_j = Σ_b 2 w_b ρ'_b Σ_i r_i ∂r_i/∂p_j
  std::vector<double> gradient(n);
  for (const ResidualBlock& block : layout().blocks) {
    double squares = 0;
    for (std::size_t i = block.offset; i < block.offset + block.size; ++i) squares += residuals[i] * residuals[i];
    const double factor = 2 * block.weight * slope(block, squares);
    for (std::size_t i = block.offset; i < block.offset + block.size; ++i)
      for (std::size_t j = 0; j < n; ++j) gradient[j] += factor * residuals[i] * rows[i * n + j];
  }
  return gradient;
}

}  // namespace tunica::serving
