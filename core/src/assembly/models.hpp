// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "assembly/parameter_vector.hpp"
#include "tunica/model.hpp"

namespace tunica::assembly {

/// One model of the run, with its mechanisms.
struct RunModel {
  std::string name, plugin;
  std::shared_ptr<Model> model;  ///< one for all states of the specimen
  ParameterVector parameters;
  std::string state = {};  ///< the specimen's state of these parameters; empty = that of the models
};

/// A strip with free lateral faces among the tests of a run, and the stretches it was measured at.
struct Strip {
  std::string test;
  std::size_t model = 0;  ///< the position of its model among those of the run
  std::size_t axis = 0;   ///< 0 = circumferential, 1 = axial
  std::vector<double> stretches;
};

/// The models of a run with their mechanisms: the run's own first, then those of layers. Also the stretches that the
/// models reach in the run.
class Models {
 public:
  Models(std::vector<RunModel> models, std::vector<Strip> strips, double largest_stretch)
      : models_(std::move(models)), strips_(std::move(strips)), largest_stretch_(largest_stretch) {}

  /// In every state of the specimen, those of the state of the models first.
  [[nodiscard]] std::size_t count() const { return models_.size(); }
  /// Without those of other states.
  [[nodiscard]] std::size_t in_one_state() const {
    return static_cast<std::size_t>(
        std::count_if(models_.begin(), models_.end(), [](const RunModel& one) { return one.state.empty(); }));
  }
  /// In a state other than that of the models, "gho (relaxed)".
  [[nodiscard]] const std::string& name(std::size_t model) const { return models_[model].name; }
  [[nodiscard]] const Model& model(std::size_t model) const { return *models_[model].model; }
  /// The positions of the free parameters in the model's vector.
  [[nodiscard]] const ParameterVector& vector(std::size_t model) const { return models_[model].parameters; }
  /// All parameters of a model, in its order.
  [[nodiscard]] std::vector<double> parameters(std::size_t model, std::span<const double> free) const {
    return vector(model).at(free);
  }
  [[nodiscard]] const std::vector<Strip>& strips() const { return strips_; }  ///< free strips among the tests
  /// Among the abscissae of all tests and stated ranges; 1 = none.
  [[nodiscard]] double largest_stretch() const { return largest_stretch_; }

 private:
  std::vector<RunModel> models_;
  std::vector<Strip> strips_;
  double largest_stretch_;
};

}  // namespace tunica::assembly
