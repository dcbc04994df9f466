// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "tunica/models/hyperelastic.hpp"

namespace tunica::testing {

/// ψ = (a/2 + b) x of an invariant that is given, whatever the parameters: a neo-Hookean matrix by default.
class MadeUpPart final : public EnergyPart {
 public:
  Invariant x = {.i1 = 1, .offset = -3};
  Description description = {"made up", Role::matrix, Active::always, false, {}, {0, 1}, true};

  [[nodiscard]] const Description& describe() const override { return description; }
  void invariant(std::span<const double>, Invariant& value, std::span<Invariant> derivatives) const override {
    value = x;
    for (Invariant& derivative : derivatives) derivative = {};
  }
  void respond(std::span<const double> p, const ResponseBatch& batch) const override {
    const std::size_t n = batch.x.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (!batch.value.empty()) batch.value[i] = (p[0] / 2 + p[1]) * batch.x[i];
      if (!batch.first.empty()) batch.first[i] = p[0] / 2 + p[1];
      if (!batch.second.empty()) batch.second[i] = 0;
      for (std::size_t j = 0; j < 2; ++j) {
        if (!batch.value_dp.empty()) batch.value_dp[j * n + i] = (j == 0 ? 0.5 : 1) * batch.x[i];
        if (!batch.first_dp.empty()) batch.first_dp[j * n + i] = j == 0 ? 0.5 : 1;
      }
    }
  }
};

/// A model of such a part, or of none, that answers 42 itself: so one sees who has answered.
class MadeUpModel final : public Model {
 public:
  explicit MadeUpModel(std::unique_ptr<EnergyPart> part) {
    description_.type = "made_up";
    description_.parameters = {{"a", "kPa", 3, 0, 100, Scale::linear, "", ""},
                               {"b", "kPa", 5, 0, 100, Scale::linear, "", ""}};
    description_.principal_axes = description_.energy_derivatives = true;
    if (part) parts_.push_back(std::move(part));
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  [[nodiscard]] std::span<const std::unique_ptr<EnergyPart>> parts() const override { return parts_; }
  Status evaluate(const MaterialPoints&, const MaterialResponse& response) const override {
    for (const auto& out : {response.energy, response.stress, response.tangent, response.stress_dp})
      for (double& entry : out) entry = 42;
    return {};
  }
  Status evaluate_axes(const AxisPoints&, const AxisResponse& response) const override {
    for (const auto& out : {response.energy, response.gradient, response.hessian, response.gradient_dp})
      for (double& entry : out) entry = 42;
    return {};
  }

 private:
  ModelDescription description_;
  std::vector<std::unique_ptr<EnergyPart>> parts_;
};

}  // namespace tunica::testing
