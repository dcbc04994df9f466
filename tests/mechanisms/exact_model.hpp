// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "tunica/model.hpp"

namespace tunica::testing {

/// A model that takes its interface by the word: every span has the length that its description says, or is empty. It
/// carries one double a point, the number of steps that it has taken, unless it is told to have no memory. `calls`
/// counts evaluations where it is given.
class ExactModel final : public Model {
 public:
  explicit ExactModel(std::unique_ptr<Model> base, std::size_t* calls = nullptr, bool memory = true)
      : base_(std::move(base)), description_(base_->describe()), calls_(calls) {
    description_.history_size = memory ? 1 : 0;
    description_.principal_axes = false;
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    if (calls_ != nullptr) ++*calls_;
    const std::size_t n = points.count, parameters = description_.parameters.size();
    const auto is = [n](const auto& span, std::size_t each) { return span.empty() || span.size() == each * n; };
    if (points.parameters.size() != parameters) return Status::failed("parameters of somebody else");
    if (points.C.size() != 6 * n || !is(points.time_step, 1) || !is(points.state, 1))
      return Status::failed("an input of another size");
    if (!is(response.energy, 1) || !is(response.stress, 6) || !is(response.tangent, 36) ||
        !is(response.stress_dp, 6 * parameters) || !is(response.state, 1))
      return Status::failed("an output of another size");
    MaterialResponse bare = response;
    bare.state = {};
    const Status status = base_->evaluate({n, points.C, points.parameters, {}, {}}, bare);
    for (std::size_t i = 0; i < response.state.size(); ++i)
      response.state[i] = 1 + (points.state.empty() ? 0 : points.state[i]);
    return status;
  }

 private:
  std::unique_ptr<Model> base_;
  ModelDescription description_;
  std::size_t* calls_;
};

}  // namespace tunica::testing
