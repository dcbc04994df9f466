// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "tunica/model.hpp"

namespace tunica {

/// A part of a base model, as a part of the mechanism's model.
///
/// It keeps the base alive. The base's parameters come first, so that the indices of the part stay valid. A mechanism
/// that changes the part derives from it and overrides invariant() or respond(); base_count() is then the index of its
/// amplitude. Threads and failure: as EnergyPart.
class ForwardedPart : public EnergyPart {
 public:
  /// `part` is one of base->parts().
  ForwardedPart(std::shared_ptr<const Model> base, const EnergyPart& part)
      : base_(std::move(base)), part_(part), description_(part.describe()) {}

  [[nodiscard]] const Description& describe() const override { return description_; }
  void invariant(std::span<const double> parameters, Invariant& value,
                 std::span<Invariant> derivatives) const override {
    part_.invariant(parameters.first(base_count()), value, derivatives);
  }
  void respond(std::span<const double> parameters, const ResponseBatch& batch) const override {
    part_.respond(parameters.first(base_count()), batch);
  }

 protected:
  /// Parameters of the base, which come first.
  [[nodiscard]] std::size_t base_count() const { return base_->describe().parameters.size(); }

  std::shared_ptr<const Model> base_;  ///< owner of the part
  const EnergyPart& part_;             ///< the part of the base, unchanged
  Description description_;            ///< a copy, which a mechanism may change in its constructor
};

/// A new part of the mechanism's model, with parameters of its own that come after those of the base.
class AddedPart final : public EnergyPart {
 public:
  /// `part` counts parameters from the first one of the mechanism; this class adds `base_count` to its indices.
  AddedPart(std::size_t base_count, std::unique_ptr<EnergyPart> part)
      : base_count_(base_count), part_(std::move(part)), description_(part_->describe()) {
    for (auto* indices : {&description_.invariant_parameters, &description_.response_parameters})
      for (std::size_t& index : *indices) index += base_count_;
  }

  [[nodiscard]] const Description& describe() const override { return description_; }
  void invariant(std::span<const double> parameters, Invariant& value,
                 std::span<Invariant> derivatives) const override {
    part_->invariant(parameters.subspan(base_count_), value, derivatives);
  }
  void respond(std::span<const double> parameters, const ResponseBatch& batch) const override {
    part_->respond(parameters.subspan(base_count_), batch);
  }

 private:
  std::size_t base_count_;
  std::unique_ptr<EnergyPart> part_;
  Description description_;
};

}  // namespace tunica
