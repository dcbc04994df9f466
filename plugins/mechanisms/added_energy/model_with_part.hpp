// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "tunica/models/forwarded_part.hpp"
#include "tunica/models/hyperelastic.hpp"

namespace tunica::added_energy {

/// A base model whose energy exposes no parts, and a part beside it: W + ψ, each evaluated by itself and added up. The
/// mechanism's parameters stand behind those of the base, its amplitude first; at the null 0 the base answers alone,
/// bit for bit, unless derivatives by parameters are wanted. History is the base's.
class ModelWithPart final : public Model {
 public:
  ModelWithPart(std::shared_ptr<const Model> base, const std::vector<Parameter>& own, std::unique_ptr<EnergyPart> part)
      : base_(std::move(base)),
        count_(base_->describe().parameters.size()),
        description_(described(*base_, own)),
        part_(description_, energy_parts(std::make_unique<AddedPart>(count_, std::move(part)))) {}

  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const std::size_t n = points.count, by_base = 6 * count_ * n;
    MaterialPoints bare = points;
    bare.parameters = points.parameters.first(count_);
    MaterialResponse of_base = out;
    of_base.stress_dp = out.stress_dp.first(out.stress_dp.empty() ? 0 : by_base);
    if (Status status = base_->evaluate(bare, of_base); !status.ok()) return status;
    if (points.parameters[count_] == 0 && out.stress_dp.empty()) return {};
    std::vector<double> energy(out.energy.size()), stress(out.stress.size()), tangent(out.tangent.size()),
        stress_dp(out.stress_dp.size());
    const MaterialPoints elastic{n, points.C, points.parameters, {}, {}};
    if (Status status = part_.evaluate(elastic, {energy, stress, tangent, stress_dp, {}}); !status.ok()) return status;
    if (!out.stress_dp.empty())
      std::fill(out.stress_dp.begin() + static_cast<std::ptrdiff_t>(by_base), out.stress_dp.end(), 0.0);
    add(energy, out.energy);
    add(stress, out.stress);
    add(tangent, out.tangent);
    add(stress_dp, out.stress_dp);
    return {};
  }

  Status evaluate_axes(const AxisPoints& points, const AxisResponse& out) const override {
    const std::size_t n = points.count, by_base = 3 * count_ * n;
    AxisResponse of_base = out;
    of_base.gradient_dp = out.gradient_dp.first(out.gradient_dp.empty() ? 0 : by_base);
    of_base.energy_dp = out.energy_dp.first(out.energy_dp.empty() ? 0 : count_ * n);
    if (Status status = base_->evaluate_axes({n, points.c, points.parameters.first(count_)}, of_base); !status.ok())
      return status;
    if (points.parameters[count_] == 0 && out.gradient_dp.empty() && out.energy_dp.empty()) return {};
    std::vector<double> energy(out.energy.size()), gradient(out.gradient.size()), hessian(out.hessian.size()),
        gradient_dp(out.gradient_dp.size()), energy_dp(out.energy_dp.size());
    if (Status status = part_.evaluate_axes(points, {energy, gradient, hessian, gradient_dp, energy_dp}); !status.ok())
      return status;
    if (!out.energy_dp.empty())
      std::fill(out.energy_dp.begin() + static_cast<std::ptrdiff_t>(count_ * n), out.energy_dp.end(), 0.0);
    if (!out.gradient_dp.empty())
      std::fill(out.gradient_dp.begin() + static_cast<std::ptrdiff_t>(by_base), out.gradient_dp.end(), 0.0);
    add(energy, out.energy);
    add(gradient, out.gradient);
    add(hessian, out.hessian);
    add(gradient_dp, out.gradient_dp);
    add(energy_dp, out.energy_dp);
    return {};
  }

 private:
  static ModelDescription described(const Model& base, const std::vector<Parameter>& own) {
    ModelDescription description = base.describe();
    description.parameters.insert(description.parameters.end(), own.begin(), own.end());
    description.axis_history_size = 0;  // memory of the base is followed in tensors
    return description;
  }
  static void add(const std::vector<double>& more, std::span<double> onto) {
    for (std::size_t i = 0; i < more.size(); ++i) onto[i] += more[i];
  }

  std::shared_ptr<const Model> base_;
  std::size_t count_;
  ModelDescription description_;
  Hyperelastic part_;
};

}  // namespace tunica::added_energy
