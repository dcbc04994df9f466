// SPDX-License-Identifier: Apache-2.0
#include "material.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tunica::thick_wall {
namespace {

/// (a, b) of the six pairs tt, zz, rr, tz, zr, tr.
constexpr std::array<std::array<std::size_t, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

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
  if (!axes_) return on_tensors(n, c, gradient, hessian, gradient_dp, memory);
  return model_->evaluate_axes({n, c, parameters_}, {{}, gradient, hessian, gradient_dp});
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
