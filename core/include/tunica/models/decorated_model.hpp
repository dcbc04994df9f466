// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "tunica/models/forwarded_part.hpp"
#include "tunica/models/hyperelastic.hpp"

namespace tunica {

/// A base model whose energy parts a mechanism has changed or added to. The mechanism's parameters stand behind those
/// of the base, its amplitude first; where that is at its null it is the base itself that answers, bit for bit, unless
/// derivatives by parameters are wanted.
class DecoratedModel final : public Hyperelastic {
 public:
  /// `own`: the mechanism's parameters, the amplitude first; `null`: of the amplitude; `parts`: of the whole changed
  /// energy, with parameters of base and mechanism in that order.
  DecoratedModel(std::shared_ptr<const Model> base, const std::vector<Parameter>& own, double null,
                 std::vector<std::unique_ptr<EnergyPart>> parts)
      : Hyperelastic(described(*base, own), std::move(parts)),
        base_(std::move(base)),
        count_(base_->describe().parameters.size()),
        null_(null) {}

  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    if (points.parameters[count_] != null_ || !response.stress_dp.empty())
      return Hyperelastic::evaluate(points, response);
    MaterialPoints bare = points;
    bare.parameters = points.parameters.first(count_);
    return base_->evaluate(bare, response);
  }
  Status evaluate_axes(const AxisPoints& points, const AxisResponse& response) const override {
    if (points.parameters[count_] != null_ || !response.gradient_dp.empty() || !base_->describe().principal_axes)
      return Hyperelastic::evaluate_axes(points, response);
    return base_->evaluate_axes({points.count, points.c, points.parameters.first(count_)}, response);
  }

 private:
  static ModelDescription described(const Model& base, const std::vector<Parameter>& own) {
    ModelDescription description = base.describe();
    description.parameters.insert(description.parameters.end(), own.begin(), own.end());
    description.parameter_derivatives = true;  // from the parts, whatever the base itself offers
    return description;
  }

  std::shared_ptr<const Model> base_;
  std::size_t count_;
  double null_;
};

}  // namespace tunica
