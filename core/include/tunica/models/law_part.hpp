// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <utility>

#include "tunica/energy_part.hpp"
#include "tunica/models/autodiff.hpp"

namespace tunica {

/// An energy part from two formulas: a law ψ(x; p) (laws.hpp) and the invariant x it is a function of,
///
///     struct Geometry { template <class T> static InvariantOf<T> invariant(std::span<const T> parameters); };
///
/// `parameters` are those of the whole model in its order; angles are in degrees, as declared. Derivatives follow by
/// automatic differentiation, unless the law has its own. `model_parameters` is the number of the model's parameters.
/// Threads and failure: as EnergyPart.
template <class Law, class Geometry, std::size_t model_parameters>
class LawPart final : public EnergyPart {
 public:
  /// `description.response_parameters` are the indices of the p of the law, in its order.
  explicit LawPart(Description description) : description_(std::move(description)) {}

  [[nodiscard]] const Description& describe() const override { return description_; }

  void invariant(std::span<const double> parameters, Invariant& value,
                 std::span<Invariant> derivatives) const override {
    value = Geometry::template invariant<double>(parameters);
    if (derivatives.empty()) return;
    using Jet = ceres::Jet<double, 1>;
    for (std::size_t k = 0; k < derivatives.size(); ++k) {
      std::array<Jet, model_parameters> jets;
      for (std::size_t j = 0; j < model_parameters; ++j) jets[j] = Jet(parameters[j]);
      jets[description_.invariant_parameters[k]].v[0] = 1;
      const InvariantOf<Jet> x = Geometry::template invariant<Jet>(std::span<const Jet>(jets));
      derivatives[k] = {x.i1.v[0], x.i2.v[0], x.fibre.v[0], x.normal.v[0], x.across.v[0], x.offset.v[0], x.angle.v[0]};
    }
  }

  void respond(std::span<const double> parameters, const ResponseBatch& batch) const override {
    std::array<double, Law::parameter_count> own;
    for (std::size_t j = 0; j < own.size(); ++j) own[j] = parameters[description_.response_parameters[j]];
    tunica::respond<Law>(own, batch);
  }

 private:
  Description description_;
};

}  // namespace tunica
