// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tunica/model.hpp"

namespace tunica {

/// A base model to which a mechanism adds memory: damage, softening, a viscous branch.
///
/// The mechanism's parameters come after those of the base, the amplitude first. Its state comes after the base's
/// state. This class divides each call between the two; a subclass implements one step and sees only its own part.
///
/// Parameter derivatives of a single step are refused, because the state depends on the parameters of earlier steps.
/// parts() are those of the base, and add up to the energy of the response without memory. They give the directions and
/// names of terms. A mechanism that rebuilds an energy from them would lose the memory. Such mechanisms are therefore
/// applied to the base first (Stage), or add to the whole model (ModelSum). A subclass may declare its number of state
/// doubles in principal axes and implement remember_step(). Tests that follow paths in principal axes then have exact
/// derivatives along whole paths. Elsewhere the host differences whole paths. evaluate_axes() is off, because a single
/// call has no history.
/// Threads and failure: as Model.
class HistoryModel : public Model {
 public:
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  /// Those of the base: the energy without memory.
  [[nodiscard]] std::span<const std::unique_ptr<EnergyPart>> parts() const override { return base_->parts(); }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const final {
    if (!response.stress_dp.empty())
      return Status::failed(id_ + ": no parameter derivatives at a single step; difference the whole path");
    const std::size_t count = base_->describe().parameters.size();
    const std::size_t state = points.count * base_->describe().history_size;
    Step step{points, response, points.parameters.subspan(count), {}, {}};
    step.base_points.parameters = points.parameters.first(count);
    if (!points.state.empty()) {
      step.base_points.state = points.state.first(state);
      step.old_state = points.state.subspan(state);
    }
    if (!response.state.empty()) {
      step.base_response.state = response.state.first(state);
      step.new_state = response.state.subspan(state);
    }
    return evaluate_step(step);
  }

  [[nodiscard]] const Model& elastic() const final { return base_->elastic(); }
  [[nodiscard]] bool remembers(std::span<const double> parameters) const final {
    const std::size_t count = base_->describe().parameters.size();
    return parameters[count] != null_ || base_->remembers(parameters.first(count));
  }
  void remember(const AxisStep& step) const final {
    const ModelDescription& base = base_->describe();
    AxisStep own = step;
    own.parameters = step.parameters.first(base.parameters.size());
    if (base.axis_history_size > 0) base_->remember(own);
    own.parameters = step.parameters.subspan(base.parameters.size());
    if (step.parameter_place > 0) own.parameter_place = step.parameter_place + base.parameters.size();
    own.state = step.state + base.axis_history_size * step.width;
    remember_step(own);
  }

 protected:
  /// One call, divided between the base and the mechanism.
  struct Step {
    /// The input of the base: its parameters and its old state.
    MaterialPoints base_points;
    /// The output of the base. Its spans are those of the caller, except for the state; a subclass may replace empty
    /// ones by scratch of its own.
    MaterialResponse base_response;
    /// The mechanism's own parameters.
    std::span<const double> parameters;
    /// Its old state, component-major; empty = at rest.
    std::span<const double> old_state;
    /// Its new state, component-major; empty = not wanted.
    std::span<double> new_state;
  };

  /// `id` begins messages; `own` are the mechanism's parameters, `own_history` the doubles of its state at a point.
  /// `own_axis_history` are the doubles that remember_step() carries, 0 = it is not implemented. `null` is the null of
  /// the amplitude.
  HistoryModel(std::string id, std::unique_ptr<Model> base, const std::vector<Parameter>& own, std::size_t own_history,
               std::size_t own_axis_history = 0, double null = 0)
      : id_(std::move(id)), base_(std::move(base)), description_(base_->describe()), null_(null) {
    const ModelDescription& bare = base_->describe();
    const bool followed = bare.history_size > 0
                              ? bare.axis_history_size > 0
                              : bare.principal_axes && bare.parameter_derivatives && bare.energy_derivatives;
    description_.axis_history_size = followed && own_axis_history > 0 ? bare.axis_history_size + own_axis_history : 0;
    description_.parameters.insert(description_.parameters.end(), own.begin(), own.end());
    description_.history_size += own_history;
    description_.principal_axes = false;
    description_.parameter_derivatives = false;
  }

  /// Evaluates one step. At the null of the amplitude the outputs are those of the base, bit for bit.
  virtual Status evaluate_step(Step& step) const = 0;
  /// The same step in principal axes: parameters, their place in rows and the state are the mechanism's own.
  virtual void remember_step([[maybe_unused]] const AxisStep& step) const {}
  /// The model without the mechanism.
  [[nodiscard]] const Model& base() const { return *base_; }

 private:
  std::string id_;
  std::unique_ptr<Model> base_;
  ModelDescription description_;
  double null_;
};

}  // namespace tunica
