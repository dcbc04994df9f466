// SPDX-License-Identifier: Apache-2.0
#include "material.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tunica::thick_wall {
namespace {

/// (a, b) of the six pairs tt, zz, rr, tz, zr, tr.
constexpr std::array<std::array<std::size_t, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
/// The reverse: which of the six (a, b) is.
constexpr std::array<std::array<std::size_t, 3>, 3> component{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};

}  // namespace

Material::Material(const Model& model, std::span<const double> parameters) : model_(&model), parameters_(parameters) {
  const ModelDescription& description = model.describe();
  axes_ = description.principal_axes && description.history_size == 0;
  if (description.history_size > 0) return;  // its points are material points and stay where they are
  for (const auto& part : model.parts()) {
    const EnergyPart::Active active = part->describe().active;
    if (active == EnergyPart::Active::always) continue;
    Invariant x;
    part->invariant(parameters, x, {});
    const double s = std::sin(x.angle), c = std::cos(x.angle);
    if (active == EnergyPart::Active::fibre_stretched)
      switches_.push_back({s * s, c * c, 0, -1});
    else if (x.i2 == 0)
      switches_.push_back({x.i1 + x.fibre * s * s, x.i1 + x.fibre * c * c, x.i1 + x.normal, x.offset});
  }
}

Status Material::evaluate(std::size_t n, std::span<const double> c, std::span<double> gradient,
                          std::span<double> hessian, std::span<double> gradient_dp, const Memory& memory) const {
  if (model_->describe().axis_history_size > 0 && gradient_dp.empty())
    return with_memory(n, c, gradient, hessian, memory);
  if (!axes_) return on_tensors(n, c, gradient, hessian, gradient_dp, memory);
  return model_->evaluate_axes({n, c, parameters_}, {{}, gradient, hessian, gradient_dp});
}

/// The elastic response in one batch, at rest too where the path begins; then memory point by point, with derivatives
/// by the three squared stretches. The state of a point without memory given is that at rest.
Status Material::with_memory(std::size_t n, std::span<const double> c, std::span<double> gradient,
                             std::span<double> hessian, const Memory& memory) const {
  thread_local std::vector<double> points, energy, g, h, state;
  const Model& elastic = model_->elastic();
  const std::size_t history = model_->describe().axis_history_size, all = n + 1;
  const bool begins = memory.old_state.empty();
  points.resize(3 * all);
  energy.resize(all);
  g.resize(3 * all);
  h.resize(hessian.empty() ? 0 : 6 * all);
  for (std::size_t a = 0; a < 3; ++a) {
    std::copy_n(&c[a * n], n, &points[a * all]);
    points[a * all + n] = 1;
  }
  const auto elastic_parameters = parameters_.first(elastic.describe().parameters.size());
  if (Status status = elastic.evaluate_axes({all, points, elastic_parameters}, {energy, g, h, {}, {}}); !status.ok())
    return status;

  const std::size_t width = hessian.empty() ? 1 : 4;
  std::array<double, 12> stretches{}, gradients{};
  std::array<double, 4> energies{};
  state.assign(2 * history * width, 0);
  const std::span<double> at_rest(state.data() + history * width, history * width);
  AxisStep step{width,
                0,
                parameters_,
                0,
                !memory.time_step.empty(),
                true,
                begins,
                stretches.data(),
                energies.data(),
                gradients.data(),
                at_rest.data()};
  const auto load = [&](std::size_t i) {
    energies[0] = energy[i];
    for (std::size_t a = 0; a < 3; ++a) {
      stretches[a * width] = points[a * all + i];
      gradients[a * width] = g[a * all + i];
      if (width == 1) continue;
      energies[1 + a] = g[a * all + i];
      for (std::size_t b = 0; b < 3; ++b) {
        stretches[a * width + 1 + b] = a == b;
        gradients[a * width + 1 + b] = h[component[a][b] * all + i];
      }
    }
  };
  if (begins) {
    load(n);
    model_->remember(step);
    for (std::size_t s = 0; s < history; ++s) std::fill_n(at_rest.data() + s * width + 1, width - 1, 0.0);
  }
  step.at_rest = false;
  step.state = state.data();
  for (std::size_t i = 0; i < n; ++i) {
    load(i);
    for (std::size_t s = 0; s < history; ++s) {
      std::fill_n(&state[s * width], width, 0.0);
      state[s * width] = begins ? at_rest[s * width] : memory.old_state[s * n + i];
    }
    if (step.timed) step.time_step = memory.time_step[i];
    model_->remember(step);
    for (std::size_t a = 0; a < 3; ++a) gradient[a * n + i] = gradients[a * width];
    for (std::size_t k = 0; k < 6 && width > 1; ++k)
      hessian[k * n + i] = gradients[pair[k][0] * width + 1 + pair[k][1]];
    if (!memory.new_state.empty())
      for (std::size_t s = 0; s < history; ++s) memory.new_state[s * n + i] = state[s * width];
  }
  return {};
}

Status Material::on_tensors(std::size_t n, std::span<const double> c, std::span<double> gradient,
                            std::span<double> hessian, std::span<double> gradient_dp, const Memory& memory) const {
  thread_local std::vector<double> tensors, stress, tangent, stress_dp;
  const std::size_t parameters = gradient_dp.empty() ? 0 : parameters_.size();
  tensors.assign(6 * n, 0);
  stress.resize(6 * n);
  tangent.resize(36 * n);
  stress_dp.resize(6 * parameters * n);
  std::copy_n(c.begin(), 3 * n, tensors.begin());
  Status status = model_->evaluate({n, tensors, parameters_, memory.time_step, memory.old_state},
                                   {{}, stress, tangent, stress_dp, memory.new_state});
  if (!status.ok()) return status;
  for (std::size_t k = 0; k < 3 * n; ++k) gradient[k] = stress[k] / 2;
  for (std::size_t k = 0; k < hessian.size() / n; ++k)
    for (std::size_t i = 0; i < n; ++i) hessian[k * n + i] = tangent[(6 * pair[k][0] + pair[k][1]) * n + i] / 4;
  for (std::size_t j = 0; j < parameters; ++j)
    for (std::size_t k = 0; k < 3 * n; ++k) gradient_dp[3 * j * n + k] = stress_dp[6 * j * n + k] / 2;
  return {};
}

}  // namespace tunica::thick_wall
