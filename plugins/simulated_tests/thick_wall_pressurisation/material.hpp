// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "tunica/model.hpp"

namespace tunica::thick_wall {

/// The history of a point of the wall, for models with memory; empty spans otherwise.
struct Memory {
  std::span<const double> time_step, old_state;
  std::span<double> new_state;
};

/// A surface where the energy of a part begins to count, tt c_t + zz c_z + rr c_r + offset = 0: there the stress has a
/// kink, and quadrature over the wall has to stop and start again.
struct Switch {
  double tt, zz, rr, offset;
};

/// The model at fixed parameters, asked for first and second derivatives of W by the squared stretches whatever it
/// offers: through its principal-axes path, or through full tensors, g_a = S_aa/2 and ∂²W/∂c_a∂c_b = A_ab/4.
class Material {
 public:
  Material(const Model& model, std::span<const double> parameters);

  [[nodiscard]] std::size_t parameter_count() const { return parameters_.size(); }
  /// Doubles that a point remembers, in principal axes where the model can do that.
  [[nodiscard]] std::size_t history_size() const {
    const ModelDescription& model = model_->describe();
    return model.axis_history_size > 0 ? model.axis_history_size : model.history_size;
  }
  [[nodiscard]] std::span<const Switch> switches() const { return switches_; }

  /// n points; layouts of AxisPoints and AxisResponse. An empty span means "not wanted".
  Status evaluate(std::size_t n, std::span<const double> c, std::span<double> gradient, std::span<double> hessian,
                  std::span<double> gradient_dp, const Memory& memory = {}) const;

 private:
  Status with_memory(std::size_t n, std::span<const double> c, std::span<double> gradient, std::span<double> hessian,
                     const Memory& memory) const;
  Status on_tensors(std::size_t n, std::span<const double> c, std::span<double> gradient, std::span<double> hessian,
                    std::span<double> gradient_dp, const Memory& memory) const;
  const Model* model_;
  std::span<const double> parameters_;
  bool axes_;
  std::vector<Switch> switches_;
};

}  // namespace tunica::thick_wall
