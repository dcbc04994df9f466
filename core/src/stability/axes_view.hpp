// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tunica/model.hpp"

namespace tunica::stability {

/// Any model at equilibrium along the principal axes: passes evaluate_axes() through where the model has it, else takes
/// S and 2 ∂S/∂C of evaluate() on diagonal C apart,
///
///   g_a = S_aa/2,   ∂²W/∂c_a∂c_b = ¼ (2 ∂S_aa/∂C_bb),   ∂g_a/∂p = ½ ∂S_aa/∂p.
///
/// A model with history answers as after an infinitely slow path from rest. Refers to the model.
class AxesView final : public Model {
 public:
  explicit AxesView(const Model& model) : model_(model) {}
  [[nodiscard]] const ModelDescription& describe() const override { return model_.describe(); }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    return model_.evaluate(points, response);
  }
  Status evaluate_axes(const AxisPoints& points, const AxisResponse& response) const override;
  bool solve_strip(const StripPath& strip, Status& status) const override {
    return has_axes() && model_.solve_strip(strip, status);
  }
  /// Those of a model with history do not say what memory makes of the response.
  [[nodiscard]] std::span<const std::unique_ptr<EnergyPart>> parts() const override {
    return has_axes() ? model_.parts() : std::span<const std::unique_ptr<EnergyPart>>{};
  }

 private:
  [[nodiscard]] bool has_axes() const {
    return model_.describe().principal_axes && model_.describe().history_size == 0;
  }
  const Model& model_;
};

}  // namespace tunica::stability
