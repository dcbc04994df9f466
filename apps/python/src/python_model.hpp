// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "kept.hpp"
#include "tunica/model.hpp"

namespace tunica::python {

/// An energy written in Python: an object with
///
///   evaluate(C, parameters, wanted)       C: (6, n) array, components as MaterialPoints has them
///   evaluate_axes(c, parameters, wanted)  c: (3, n) array of squared stretches
///
/// `wanted` names entries of MaterialResponse or AxisResponse, and the answer is a dictionary of arrays in their
/// layout.
class PythonModel final : public Model {
 public:
  PythonModel(ModelDescription description, Kept object)
      : description_(std::move(description)), object_(std::move(object)), owner_("model '" + description_.type + "'") {}
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override;
  Status evaluate_axes(const AxisPoints& points, const AxisResponse& response) const override;

 private:
  ModelDescription description_;
  Kept object_;
  std::string owner_;
};

/// A base model with an energy written in Python beside it, whose parameters stand behind those of the base. At the
/// null of the first of them the base answers alone, bit for bit.
class AddedPythonEnergy final : public Model {
 public:
  AddedPythonEnergy(std::unique_ptr<Model> base, std::unique_ptr<PythonModel> added, double null);
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override;
  Status evaluate_axes(const AxisPoints& points, const AxisResponse& response) const override;
  bool solve_strip(const StripPath& strip, Status& status) const override;

 private:
  std::unique_ptr<Model> base_;
  std::unique_ptr<PythonModel> added_;
  ModelDescription description_;
  std::size_t own_;  ///< where the own parameters begin
  double null_;
};

}  // namespace tunica::python
