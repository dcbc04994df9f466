// SPDX-License-Identifier: Apache-2.0
#include "discovery/reach.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <utility>

#include "assembly/assembly.hpp"
#include "numerics/eigenpairs.hpp"
#include "tunica/detail/free_faces.hpp"

namespace tunica::discovery {
namespace {

/// Where states are written down.
struct Record {
  std::mutex mutex;
  States converged, all;
};

/// A model that records the points of its calls and returns the results of the wrapped model.
class RecordingModel final : public Model {
 public:
  RecordingModel(std::unique_ptr<Model> model, std::shared_ptr<Record> record)
      : model_(std::move(model)), record_(std::move(record)) {}

  [[nodiscard]] const ModelDescription& describe() const override { return model_->describe(); }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    const std::size_t n = points.count;
    const std::scoped_lock lock(record_->mutex);
    for (std::size_t i = 0; i < n; ++i) {
      std::array<double, 6> C;
      for (std::size_t c = 0; c < 6; ++c) C[c] = points.C[c * n + i];
      add(C, !response.stress_dp.empty());
    }
    return model_->evaluate(points, response);
  }
  Status evaluate_axes(const AxisPoints& points, const AxisResponse& response) const override {
    const std::size_t n = points.count;
    const std::scoped_lock lock(record_->mutex);
    for (std::size_t i = 0; i < n; ++i)
      add({points.c[i], points.c[n + i], points.c[2 * n + i], 0, 0, 0}, !response.gradient_dp.empty());
    return model_->evaluate_axes(points, response);
  }
  [[nodiscard]] std::span<const std::unique_ptr<EnergyPart>> parts() const override { return model_->parts(); }

 private:
  void add(const std::array<double, 6>& C, bool converged) const {
    if (!std::all_of(C.begin(), C.end(), [](double c) { return std::isfinite(c); })) return;
    (converged ? record_->converged : record_->all).push_back(C);
  }

  std::unique_ptr<Model> model_;
  std::shared_ptr<Record> record_;
};

/// The catalogue with one more mechanism, which records.
plugins::Catalogue recording(const plugins::Catalogue& catalogue, const std::shared_ptr<Record>& record) {
  plugins::Catalogue::Registration registration;
  MechanismFactory recorder;
  recorder.id = "state_recorder";
  recorder.stage = Stage::stress;
  recorder.wrap_model = [record](std::unique_ptr<Model> base, const Options&) -> std::unique_ptr<Model> {
    return std::make_unique<RecordingModel>(std::move(base), record);
  };
  registration.add(std::move(recorder));
  plugins::Catalogue all = catalogue;
  all.commit(std::move(registration), "tunica");
  return all;
}

template <class Value>
Reach reach(const States& states, const Value& value) {
  Reach found;
  for (const auto& C : states) {
    const double x = value(C);
    found.low = std::min(found.low, x);
    found.high = std::max(found.high, x);
  }
  return found;
}

double first(const std::array<double, 6>& C) { return C[0] + C[1] + C[2] - 3; }
/// I2 = C_tt C_zz + C_zz C_rr + C_rr C_tt − C_tz² − C_zr² − C_tr²
double second(const std::array<double, 6>& C) {
  return C[0] * C[1] + C[1] * C[2] + C[2] * C[0] - C[3] * C[3] - C[4] * C[4] - C[5] * C[5] - 3;
}

}  // namespace

States reached_states(const Subject& subject, std::span<const double> free) {
  const auto record = std::make_shared<Record>();
  const plugins::Catalogue catalogue = recording(subject.catalogue, record);
  experiment::Experiment experiment = subject.experiment;
  for (auto& model : experiment.models)
    if (model.name == subject.model) model.mechanisms.push_back({"state_recorder", {}, {}, {}});
  const assembly::Assembly assembly(experiment, subject.run, catalogue);
  const auto workspace = assembly.evaluator().make_workspace();
  std::vector<double> values(assembly.layout().prediction_count),
      jacobian(values.size() * assembly.layout().parameters.size());
  {
    const std::scoped_lock lock(record->mutex);
    record->converged.clear();
    record->all.clear();
  }
  (void)assembly.evaluator().predict(free, values, jacobian, *workspace);
  return record->converged.empty() ? record->all : record->converged;
}

Reach reach_of_first(const States& states) { return reach(states, first); }
Reach reach_of_second(const States& states) { return reach(states, second); }
Reach reach_of_volume(const States& states) {
  return reach(states, [](const auto& C) { return std::sqrt(free_faces::determinant(C)) - 1; });
}
Reach reach_of_product(const States& states, int m, int n) {
  return reach(states, [=](const auto& C) { return std::pow(first(C), m) * std::pow(second(C), n); });
}

States at_constant_volume(const States& states) {
  States all = states;
  for (auto& C : all) {
    const double factor = std::pow(free_faces::determinant(C), -1.0 / 3);
    for (double& component : C) component *= factor;
  }
  return all;
}

Reach reach_of_fibre(const States& states, double angle_from_axial) {
  const double angle = angle_from_axial * std::numbers::pi / 180, s = std::sin(angle), c = std::cos(angle);
  return reach(states, [=](const auto& C) { return s * s * C[0] + c * c * C[1] + 2 * s * c * C[3] - 1; });
}

Reach reach_of_stretches(const States& states) {
  Reach found;
  for (const auto& C : states) {
    Eigen::Matrix3d full;
    full << C[0], C[3], C[5], C[3], C[1], C[4], C[5], C[4], C[2];
    for (const double square : numerics::eigenpairs(full).values) {
      if (!(square > 0)) continue;
      found.low = std::min(found.low, 0.5 * std::log(square));
      found.high = std::max(found.high, 0.5 * std::log(square));
    }
  }
  return found;
}

}  // namespace tunica::discovery
