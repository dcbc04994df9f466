// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tunica/detail/hyperelastic_axes.hpp"
#include "tunica/detail/hyperelastic_tensor.hpp"
#include "tunica/model.hpp"

namespace tunica {

/// A hyperelastic model from its parts, W(C; p) = Σ_k ψ_k(x_k), x_k an invariant of C (energy_part.hpp): energy,
/// stress, tangent, parameter derivatives and the principal-axes path follow. A model plugin is a parameter table
/// and its parts.
class Hyperelastic : public Model {
 public:
  /// `description.principal_axes` is set here; throws std::invalid_argument where a part names a parameter that the
  /// description does not have.
  Hyperelastic(ModelDescription description, std::vector<std::unique_ptr<EnergyPart>> parts)
      : description_(std::move(description)), parts_(std::move(parts)) {
    description_.principal_axes = true;
    if (description_.parameters.size() > hyperelastic::max_model_parameters)
      throw std::invalid_argument("the model has more than 64 parameters");
    if (parts_.empty()) throw std::invalid_argument("the model has no energy part");
    for (const auto& part : parts_) check(part->describe());
  }

  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    hyperelastic::evaluate_tensor(parts_, points, response);
    return {};
  }
  Status evaluate_axes(const AxisPoints& points, const AxisResponse& response) const override {
    hyperelastic::evaluate_axes(parts_, points, response);
    return {};
  }
  [[nodiscard]] std::span<const std::unique_ptr<EnergyPart>> parts() const override { return parts_; }

 private:
  void check(const EnergyPart::Description& part) const {
    for (const auto* list : {&part.invariant_parameters, &part.response_parameters}) {
      if (list->size() > hyperelastic::max_part_parameters)
        throw std::invalid_argument("the part '" + part.name + "' depends on more than 16 parameters");
      for (const std::size_t index : *list) {
        if (index >= description_.parameters.size())
          throw std::invalid_argument("the part '" + part.name + "' names a parameter the model does not have");
      }
    }
  }

  ModelDescription description_;
  std::vector<std::unique_ptr<EnergyPart>> parts_;
};

}  // namespace tunica
