// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tunica/detail/symmetric_strip.hpp"
#include "tunica/model.hpp"
#include "tunica/models/volume_energy.hpp"

namespace tunica {

/// A base model and an energy beside it, W + ψ, each evaluated by itself and added up: for bases without energy parts,
/// and for energies that are none. DecoratedModel is the faster choice where both have parts.
///
/// The parameters of the added energy stand behind those of the base, its amplitude first. While the amplitude is at
/// its null, the base answers alone, bit for bit, unless derivatives by parameters are wanted. History is the base's.
/// Threads and failure: as Model. Ownership: shares the base, owns the added energy.
class ModelSum final : public Model {
 public:
  /// `own` are the parameters of `added` as the mechanism calls them. The sum has principal axes where both have them.
  /// A null that is not a number is never met.
  ModelSum(std::shared_ptr<const Model> base, const std::vector<Parameter>& own, double null,
           std::unique_ptr<Model> added)
      : base_(std::move(base)),
        added_(std::move(added)),
        count_(base_->describe().parameters.size()),
        null_(null),
        description_(described(*base_, *added_, own)) {}

  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const std::size_t by_base = out.stress_dp.empty() ? 0 : 6 * count_ * points.count;
    MaterialPoints bare = points;
    bare.parameters = points.parameters.first(count_);
    MaterialResponse of_base = out;
    of_base.stress_dp = out.stress_dp.first(by_base);
    if (Status status = base_->evaluate(bare, of_base); !status.ok()) return status;
    if (points.parameters[count_] == null_ && out.stress_dp.empty()) return {};
    std::vector<double> energy(out.energy.size()), stress(out.stress.size()), tangent(out.tangent.size());
    const MaterialPoints elastic{points.count, points.C, points.parameters.subspan(count_), {}, {}};
    if (Status status = added_->evaluate(elastic, {energy, stress, tangent, out.stress_dp.subspan(by_base), {}});
        !status.ok())
      return status;
    add(energy, out.energy);
    add(stress, out.stress);
    add(tangent, out.tangent);
    return description_.compressible ? relieve(points, out) : Status();
  }

  Status evaluate_axes(const AxisPoints& points, const AxisResponse& out) const override {
    const std::size_t n = points.count;
    const std::size_t gradients = out.gradient_dp.empty() ? 0 : 3 * count_ * n;
    const std::size_t energies = out.energy_dp.empty() ? 0 : count_ * n;
    AxisResponse of_base = out;
    of_base.gradient_dp = out.gradient_dp.first(gradients);
    of_base.energy_dp = out.energy_dp.first(energies);
    if (Status status = base_->evaluate_axes({n, points.c, points.parameters.first(count_)}, of_base); !status.ok())
      return status;
    if (points.parameters[count_] == null_ && out.gradient_dp.empty() && out.energy_dp.empty()) return {};
    std::vector<double> energy(out.energy.size()), gradient(out.gradient.size()), hessian(out.hessian.size());
    if (Status status = added_->evaluate_axes(
            {n, points.c, points.parameters.subspan(count_)},
            {energy, gradient, hessian, out.gradient_dp.subspan(gradients), out.energy_dp.subspan(energies)});
        !status.ok())
      return status;
    add(energy, out.energy);
    add(gradient, out.gradient);
    add(hessian, out.hessian);
    return {};
  }

  [[nodiscard]] bool keeps_volume(std::span<const double> parameters) const override {
    return base_->keeps_volume(parameters.first(count_)) && (!description_.compressible || parameters[count_] == null_);
  }
  [[nodiscard]] const Model& incompressible() const override {
    return description_.compressible ? base_->incompressible() : *this;
  }

  bool solve_strip(const StripPath& strip, Status& status) const override {
    if (strip.parameters[count_] != null_ || !strip.stress_dp.empty() || !description_.principal_axes) return false;
    StripPath bare = strip;
    bare.parameters = strip.parameters.first(count_);
    if (free_strip::symmetry_of_parts(*base_, bare.parameters) == free_strip::Symmetry::isotropic) return false;
    return base_->solve_strip(bare, status);
  }

 private:
  static ModelDescription described(const Model& base, const Model& added, const std::vector<Parameter>& own) {
    ModelDescription description = base.describe();
    description.principal_axes = description.principal_axes && added.describe().principal_axes;
    description.parameters.insert(description.parameters.end(), own.begin(), own.end());
    description.axis_history_size = 0;  // memory of the base is followed in tensors
    return description;
  }
  /// A compressible material bears no stress at rest: ψ − a ln J, a the stress of ψ
  /// there across the wall, where no family pulls; a tone stays.
  Status relieve(const MaterialPoints& points, const MaterialResponse& out) const {
    const std::array<double, 6> rest{1, 1, 1, 0, 0, 0};
    const std::size_t n = points.count, own = out.stress_dp.empty() ? 0 : description_.parameters.size() - count_;
    std::array<double, 6> at_rest{};
    std::vector<double> at_rest_dp(6 * own);
    if (Status status =
            added_->evaluate({1, rest, points.parameters.subspan(count_), {}, {}}, {{}, at_rest, {}, at_rest_dp, {}});
        !status.ok())
      return status;
    for (std::size_t i = 0; i < n; ++i) {
      VolumeEnergy::Tensor C;
      for (std::size_t c = 0; c < 6; ++c) C[c] = points.C[c * n + i];
      const VolumeEnergy volume(C);
      volume.add(-at_rest[2] * volume.log_volume(), -at_rest[2], 0, out, n, i);
      for (std::size_t j = 0; j < own; ++j) volume.add_parameter(count_ + j, -at_rest_dp[6 * j + 2], out, n, i);
    }
    return {};
  }
  static void add(const std::vector<double>& more, std::span<double> onto) {
    for (std::size_t i = 0; i < more.size(); ++i) onto[i] += more[i];
  }

  std::shared_ptr<const Model> base_;
  std::unique_ptr<Model> added_;
  std::size_t count_;
  double null_;
  ModelDescription description_;
};

}  // namespace tunica
