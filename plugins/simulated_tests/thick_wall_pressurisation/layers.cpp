// SPDX-License-Identifier: Apache-2.0
#include "layers.hpp"

#include <algorithm>

namespace tunica::thick_wall {

Layers::Layers(const TestInput& input) : first_{0} {
  const Model* const throughout = &input.model;
  const auto models = input.layers.empty() ? std::span(&throughout, 1) : input.layers;
  materials_.reserve(models.size());
  for (const Model* model : models) {
    const std::size_t count = model->describe().parameters.size();
    materials_.emplace_back(*model, input.model_parameters.subspan(first_.back(), count));
    first_.push_back(first_.back() + count);
  }
}

std::size_t Layers::material_of(std::size_t parameter) const {
  return static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), parameter) - first_.begin()) - 1;
}

std::size_t Layers::history_size(std::size_t points) const {
  std::size_t size = 0;
  for (const Material& material : materials_) size += points * material.history_size();
  return size;
}

Status Layers::evaluate(std::size_t n, std::span<const Run> runs, std::span<const double> c, std::span<double> gradient,
                        std::span<double> hessian, std::span<double> gradient_dp, const Memory& memory) const {
  if (size() == 1) return materials_.front().evaluate(n, c, gradient, hessian, gradient_dp, memory);
  Memory left = memory;
  for (std::size_t layer = 0; layer < size(); ++layer) {
    std::size_t points = 0;
    for (const Run& run : runs)
      if (run.layer == layer) points += run.count;
    // A material without history may have more points than before: time means nothing to it.
    const std::size_t history = points * materials_[layer].history_size();
    const Memory own = history == 0 ? Memory{}
                                    : Memory{memory.time_step.first(memory.time_step.empty() ? 0 : points),
                                             left.old_state.first(left.old_state.empty() ? 0 : history),
                                             left.new_state.first(left.new_state.empty() ? 0 : history)};
    Status status = evaluate_layer(layer, n, runs, c, gradient, hessian, gradient_dp, own);
    if (!status.ok()) return status;
    if (!left.old_state.empty()) left.old_state = left.old_state.subspan(history);
    if (!left.new_state.empty()) left.new_state = left.new_state.subspan(history);
  }
  return {};
}

/// The layer's points are gathered for one call of its model, and its results are scattered back.
Status Layers::evaluate_layer(std::size_t layer, std::size_t n, std::span<const Run> runs, std::span<const double> c,
                              std::span<double> gradient, std::span<double> hessian, std::span<double> gradient_dp,
                              const Memory& memory) const {
  thread_local std::vector<double> here_c, here_gradient, here_hessian, here_dp;
  const std::size_t parameters = gradient_dp.empty() ? 0 : materials_[layer].parameter_count();
  std::size_t points = 0;
  for (const Run& run : runs)
    if (run.layer == layer) points += run.count;
  here_c.resize(3 * points);
  here_gradient.resize(3 * points);
  here_hessian.resize(hessian.empty() ? 0 : 6 * points);
  here_dp.resize(3 * parameters * points);
  const auto copy = [&](std::size_t components, const double* from, std::size_t from_points, double* to,
                        std::size_t to_points, bool gather) {
    std::size_t at = 0;  // among the layer's points
    for (const Run& run : runs) {
      if (run.layer != layer) continue;
      for (std::size_t k = 0; k < components; ++k)
        std::copy_n(from + k * from_points + (gather ? run.first : at), run.count,
                    to + k * to_points + (gather ? at : run.first));
      at += run.count;
    }
  };
  copy(3, c.data(), n, here_c.data(), points, true);
  Status status = materials_[layer].evaluate(points, here_c, here_gradient, here_hessian, here_dp, memory);
  if (!status.ok()) return status;
  copy(3, here_gradient.data(), points, gradient.data(), n, false);
  if (!hessian.empty()) copy(6, here_hessian.data(), points, hessian.data(), n, false);
  if (parameters > 0)
    copy(3 * parameters, here_dp.data(), points, gradient_dp.data() + 3 * first_[layer] * n, n, false);
  return {};
}

}  // namespace tunica::thick_wall
