// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "tunica/model.hpp"

namespace tunica::testing {

/// A model without its principal-axes path.
class TensorsOnly : public Model {
 public:
  explicit TensorsOnly(std::unique_ptr<Model> model) : model_(std::move(model)), description_(model_->describe()) {
    description_.principal_axes = false;
    description_.axis_history_size = 0;
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    return model_->evaluate(points, response);
  }
  [[nodiscard]] std::span<const std::unique_ptr<EnergyPart>> parts() const override { return model_->parts(); }

 protected:
  std::unique_ptr<Model> model_;
  ModelDescription description_;
};

}  // namespace tunica::testing
