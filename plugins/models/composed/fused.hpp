// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tunica/models/hyperelastic.hpp"

namespace tunica::composed {

/// Parts of one invariant, the same for all of them and without parameters, as one part: ψ = Σ_k ψ_k. The kernels then
/// build stress and tangent once. Only they call it, with no more points than a chunk.
class FusedPart final : public EnergyPart {
 public:
  explicit FusedPart(EnergyParts parts) : parts_(std::move(parts)) {
    description_.name = "sum";
    description_.linear = true;
    for (const auto& part : parts_) {
      const Description& one = part->describe();
      description_.response_parameters.insert(description_.response_parameters.end(), one.response_parameters.begin(),
                                              one.response_parameters.end());
      description_.linear = description_.linear && one.linear;
    }
  }

  [[nodiscard]] const Description& describe() const override { return description_; }
  void invariant(std::span<const double> parameters, Invariant& value,
                 std::span<Invariant> derivatives) const override {
    parts_.front()->invariant(parameters, value, derivatives);
  }
  void respond(std::span<const double> parameters, const ResponseBatch& batch) const override {
    const std::size_t n = batch.x.size();
    std::array<std::array<double, hyperelastic::chunk>, 3> more;
    const std::array<std::span<double>, 3> sums{batch.value, batch.first, batch.second};
    std::size_t row = 0;  // of the derivatives by parameters, which nothing is added to
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const std::size_t count = parts_[k]->describe().response_parameters.size();
      const auto rows = [&](std::span<double> all) { return all.empty() ? all : all.subspan(row * n, count * n); };
      const auto own = [&](std::size_t q) {
        return k == 0 ? sums[q] : std::span<double>(more[q].data(), sums[q].size());
      };
      parts_[k]->respond(parameters, {batch.x, own(0), own(1), own(2), rows(batch.value_dp), rows(batch.first_dp)});
      for (std::size_t q = 0; k > 0 && q < 3; ++q)
        for (std::size_t i = 0; i < sums[q].size(); ++i) sums[q][i] += more[q][i];
      row += count;
    }
  }

 private:
  EnergyParts parts_;
  Description description_;
};

/// A sum of parts that is evaluated as another list of parts with the same sum. Mechanisms see the first one.
class FusedModel final : public Model {
 public:
  FusedModel(const ModelDescription& description, EnergyParts parts, EnergyParts evaluated)
      : whole_(description, std::move(parts)), evaluated_(description, std::move(evaluated)) {}

  [[nodiscard]] const ModelDescription& describe() const override { return whole_.describe(); }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    return evaluated_.evaluate(points, out);
  }
  Status evaluate_axes(const AxisPoints& points, const AxisResponse& out) const override {
    return evaluated_.evaluate_axes(points, out);
  }
  bool solve_strip(const StripPath& strip, Status& status) const override {
    return evaluated_.solve_strip(strip, status);
  }
  [[nodiscard]] std::span<const std::unique_ptr<EnergyPart>> parts() const override { return whole_.parts(); }

 private:
  Hyperelastic whole_, evaluated_;
};

}  // namespace tunica::composed
