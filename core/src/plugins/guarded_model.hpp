// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plugins/overrun.hpp"
#include "tunica/energy_scaled_model.hpp"
#include "tunica/maxwell_model.hpp"
#include "tunica/model.hpp"

namespace tunica::plugins {

struct Call;

/// The model whose call was the last to fail on this thread; null = none since it was set to that. Of several guards
/// around each other it is the outermost.
const Model*& last_failed_model();

/// A model of a plugin that the host need not trust. An exception, an output that is unwritten or overrun, and a call
/// that has ended a process before are all a `failed` status which names the plugin. Costs a call some 20 ns: the
/// record of calls, and marks in the outputs.
class GuardedModel final : public Model, public MaxwellModel, public EnergyScaledModel {
 public:
  GuardedModel(std::unique_ptr<Model> model, std::string plugin);
  ~GuardedModel() override;
  GuardedModel(const GuardedModel&) = delete;
  GuardedModel& operator=(const GuardedModel&) = delete;

  [[nodiscard]] const ModelDescription& describe() const override { return *description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override;
  bool solve_strip(const StripPath& strip, Status& status) const override;
  Status evaluate_axes(const AxisPoints& points, const AxisResponse& response) const override;
  [[nodiscard]] std::span<const std::unique_ptr<EnergyPart>> parts() const override { return model_->parts(); }
  [[nodiscard]] const Model& elastic() const override;
  [[nodiscard]] bool keeps_volume(std::span<const double> parameters) const override;
  [[nodiscard]] const Model& incompressible() const override;
  [[nodiscard]] bool remembers(std::span<const double> parameters) const override;
  void remember(const AxisStep& step) const override;
  /// False of a model that is no MaxwellModel.
  bool add_branches(std::vector<Branch>& found) const override;
  /// False of a model that is no EnergyScaledModel.
  bool scale_path(const ScaledPath& path, const Factors& factors) const override;

  [[nodiscard]] const std::string& plugin() const { return plugin_; }
  /// The model without its guard, for a mechanism that goes around it.
  [[nodiscard]] std::unique_ptr<Model> release() { return std::move(model_); }

 private:
  template <class Body>
  Status made(const Call& call, OverrunRecord::Function function, std::span<NamedOutput> outputs, std::size_t points,
              const Body& body, const bool* declined = nullptr) const;

  std::unique_ptr<Model> model_;
  std::string plugin_;
  const ModelDescription* description_;
  bool stricken_;  ///< an earlier process ended in this plugin: inputs are compared
  mutable OverrunRecord overruns_;
};

}  // namespace tunica::plugins
