// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "tunica/models/forwarded_part.hpp"
#include "tunica/models/hyperelastic.hpp"

namespace tunica {

/// A base model in which a mechanism changes parts of the energy or adds one.
///
/// The mechanism's parameters come after those of the base, the amplitude first. While the amplitude is at its null,
/// the results are those of the base, bit for bit. A call that wants parameter derivatives is the exception: all of its
/// results come from the changed energy.
///
/// Parts of the base that stay as they are become ForwardedPart, changed ones a subclass of it, new ones AddedPart.
/// Threads and failure: as Model. Ownership: shares the base with its forwarded parts.
class DecoratedModel final : public Hyperelastic {
 public:
  /// `own` are the mechanism's parameters, the amplitude first, and `null` is the null of the amplitude. `parts` make
  /// up the whole changed energy; they count the parameters of the base, then those of the mechanism. Throws
  /// std::invalid_argument if the base has memory, which parts do not carry: ModelSum does.
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
    if (points.parameters[count_] != null_ || !response.gradient_dp.empty() || !response.energy_dp.empty() ||
        !base_->describe().principal_axes)
      return Hyperelastic::evaluate_axes(points, response);
    return base_->evaluate_axes({points.count, points.c, points.parameters.first(count_)}, response);
  }

  bool solve_strip(const StripPath& strip, Status& status) const override {
    if (strip.parameters[count_] != null_ || !strip.stress_dp.empty() || !base_->describe().principal_axes)
      return Hyperelastic::solve_strip(strip, status);
    StripPath bare = strip;
    bare.parameters = strip.parameters.first(count_);
    return base_->solve_strip(bare, status);
  }

 private:
  static ModelDescription described(const Model& base, const std::vector<Parameter>& own) {
    ModelDescription description = base.describe();
    if (description.history_size > 0)
      throw std::invalid_argument("the parts of model '" + description.type +
                                  "' do not carry its memory, so that no energy can be rebuilt from them");
    description.parameters.insert(description.parameters.end(), own.begin(), own.end());
    description.parameter_derivatives = true;  // from the parts, whatever the base itself offers
    return description;
  }

  std::shared_ptr<const Model> base_;
  std::size_t count_;
  double null_;
};

}  // namespace tunica
