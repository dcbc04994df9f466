// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "tunica/model.hpp"

namespace tunica::testing {

/// A model with memory that does not say what its memory is: tests follow it row by row.
class RowByRow : public Model {
 public:
  explicit RowByRow(std::unique_ptr<Model> model) : model_(std::move(model)) {}
  [[nodiscard]] const ModelDescription& describe() const override { return model_->describe(); }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    return model_->evaluate(points, response);
  }
  [[nodiscard]] std::span<const std::unique_ptr<EnergyPart>> parts() const override { return model_->parts(); }
  [[nodiscard]] const Model& elastic() const override { return model_->elastic(); }
  [[nodiscard]] bool remembers(std::span<const double> parameters) const override {
    return model_->remembers(parameters);
  }
  void remember(const AxisStep& step) const override { model_->remember(step); }

 private:
  std::unique_ptr<Model> model_;
};

}  // namespace tunica::testing
