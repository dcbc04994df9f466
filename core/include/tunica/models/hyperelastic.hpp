// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tunica/detail/hyperelastic_kernels.hpp"
#include "tunica/model.hpp"
#include "tunica/plugin.hpp"

namespace tunica {

/// The parts of an energy, in the order in which they are added up.
using EnergyParts = std::vector<std::unique_ptr<EnergyPart>>;

/// A hyperelastic model as the sum of its parts, W(C; p) = Σ_k ψ_k(x_k).
///
/// Each x_k is an invariant of C, see EnergyPart. Energy, stress, tangent, parameter derivatives and the principal-axes
/// path follow from the parts. Most plugins do not name this class: hyperelastic_factory() makes it from a parameter
/// table and the parts.
///
/// Limits: 64 parameters a model, 16 a part. Threads: as Model. Kernels: tunica/detail/hyperelastic_*.hpp.
class Hyperelastic : public Model {
 public:
  /// Sets `description.principal_axes`. Throws std::invalid_argument if there is no part, or if a part names a
  /// parameter that the description does not have.
  Hyperelastic(ModelDescription description, EnergyParts parts)
      : description_(std::move(description)), parts_(std::move(parts)) {
    description_.principal_axes = true;
    description_.energy_derivatives = true;
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
  bool solve_strip(const StripPath& strip, Status& status) const override {
    return hyperelastic::solve_strip_of_parts(*this, parts_, strip, status);
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
  EnergyParts parts_;
};

/// Lists parts:
///
///     energy_parts(isotropic::neo_hookean<4>(mu), arterial::fibres<Fibres, 4>({theta}, {k1, k2}, options))
template <class... Part>
EnergyParts energy_parts(Part... part) {
  EnergyParts parts;
  (parts.push_back(std::move(part)), ...);
  return parts;
}

/// What a plugin registers for a sum of parts. `parts` is called with checked options, once for each model that the
/// host makes; the name of the model is description.type.
inline ModelFactory hyperelastic_factory(ModelDescription description, std::string doc, std::string reference,
                                         std::function<EnergyParts(const Options&)> parts,
                                         std::vector<Option> options = {}) {
  std::string type = description.type;
  return {std::move(type), std::move(doc), std::move(reference), std::move(options),
          [description = std::move(description), parts = std::move(parts)](const Options& given) {
            return std::make_unique<Hyperelastic>(description, parts(given));
          }};
}

}  // namespace tunica
