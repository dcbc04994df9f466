// SPDX-License-Identifier: Apache-2.0
// One Maxwell branch, or several side by side (a Prony series, each an instance of the mechanism), beside the base
// model, which stays the equilibrium response. With S' = Dev S of the base, the second Piola–Kirchhoff stress of a slow
// material plus
//
//   h(t) = g ∫ e^{−(t−t')/τ} dS'(t'),   at rest until t = 0
//
// (Simo 1987, Comput. Methods Appl. Mech. Eng. 60:153, eq. 3.6; Holzapfel 2000, Nonlinear Solid Mechanics, §6.10).
//
// Why Dev S and not S: in an incompressible material the energy is known up to a function of the volume, and S up to a
// multiple of C⁻¹ which the pressure absorbs. It could not absorb the memory of an earlier multiple of an earlier C⁻¹:
// with S in the integral the prediction would depend on how the energy happens to be written. S' does not.
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "deviator.hpp"
#include "tunica/maxwell_model.hpp"
#include "tunica/models/history_model.hpp"
#include "tunica/plugin.hpp"

namespace tunica::viscoelasticity {
namespace {

std::vector<Parameter> own_parameters() {
  return {{"g", "1", 0.3, 0, 10, Scale::linear,
           "Stiffness of the viscous branch, relative to the equilibrium response.", "Simo 1987, eq. 3.6"},
          {"tau", "s", 10, 0.001, 100000, Scale::log, "Relaxation time of the viscous branch.", "Simo 1987, eq. 3.6"}};
}

constexpr std::size_t own_history = 12;      // h, then S', six components each
constexpr std::size_t own_axis_history = 6;  // the same halved, on the three axes

/// The components of point i in a structure of arrays.
Tensor load(std::span<const double> from, std::size_t n, std::size_t i) {
  Tensor t;
  for (std::size_t c = 0; c < 6; ++c) t[c] = from[c * n + i];
  return t;
}
void store(std::span<double> into, std::size_t n, std::size_t i, const Tensor& t) {
  for (std::size_t c = 0; c < 6; ++c) into[c * n + i] = t[c];
}

/// For S' linear over the step, exactly: h₊ = e^{−Δt/τ} h + g φ ΔS', φ = (1 − e^{−Δt/τ})/(Δt/τ).
struct Relaxation {
  double decay, slope;  ///< e^{−Δt/τ}, g φ
  Relaxation(double of_decay, double of_slope) : decay(of_decay), slope(of_slope) {}
  Relaxation(double time_step, double g, double tau) {
    const double x = time_step / tau;
    const double lost = -std::expm1(-x);
    decay = 1 - lost;
    slope = x == 0 ? g : g * (lost / x);
  }
};

/// State: h, then S' of the last step.
class ViscoelasticModel final : public HistoryModel, public MaxwellModel {
 public:
  explicit ViscoelasticModel(std::unique_ptr<Model> base)
      : HistoryModel("viscoelasticity", std::move(base), own_parameters(), own_history, own_axis_history),
        beside_(dynamic_cast<const ViscoelasticModel*>(&this->base())) {}

  bool add_branches(std::vector<Branch>& found) const override {
    const ModelDescription& bare = base().describe();
    if (beside_ != nullptr ? !beside_->add_branches(found) : bare.history_size > 0) return false;
    found.push_back({bare.parameters.size(), bare.parameters.size() + 1});
    return true;
  }

 private:
  Status evaluate_step(Step& call) const override {
    const MaterialPoints& points = call.base_points;
    const std::size_t n = points.count;
    const double g = call.parameters[0], tau = call.parameters[1];
    const std::span<double> stress = call.base_response.stress, tangent = call.base_response.tangent;
    const bool branch = g != 0 && (!stress.empty() || !tangent.empty());
    if (!branch && call.new_state.empty()) return base().evaluate(points, call.base_response);

    // A branch beside others relaxes from the same elastic response.
    std::vector<double> elastic_stress, elastic_tangent;
    if (beside_ != nullptr) {
      elastic_stress.resize(6 * n);
      elastic_tangent.resize(branch ? tangent.size() : 0);
      if (Status status = evaluate_elastic(points, elastic_stress, elastic_tangent); !status.ok()) return status;
    }
    std::vector<double> unwanted;
    if (stress.empty()) {
      unwanted.resize(6 * n);
      call.base_response.stress = unwanted;
    }
    if (Status status = base().evaluate(points, call.base_response); !status.ok()) return status;
    Tensor rest{};
    if (call.old_state.empty() && g != 0) {
      if (Status status = deviator_at_rest(points.parameters, rest); !status.ok()) return status;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::span<const double> elastic = beside_ != nullptr ? elastic_stress : call.base_response.stress;
      const Tensor C = load(points.C, n, i), S = load(elastic, n, i), C_inverse = inverse(C);
      const Tensor now = deviator(S, C, C_inverse);
      Tensor h{};
      if (g != 0 && !points.time_step.empty()) {
        const Relaxation relaxation(points.time_step[i], g, tau);
        if (!call.old_state.empty()) h = load(call.old_state, n, i);
        const Tensor before = call.old_state.empty() ? rest : load(call.old_state.subspan(6 * n), n, i);
        for (std::size_t c = 0; c < 6; ++c) h[c] = relaxation.decay * h[c] + relaxation.slope * (now[c] - before[c]);
        if (!tangent.empty())
          add_tangent(beside_ != nullptr ? elastic_tangent : tangent, tangent, n, i, relaxation.slope, S, C, C_inverse);
        if (!stress.empty()) {
          for (std::size_t c = 0; c < 6; ++c) stress[c * n + i] += h[c];
        }
      }
      if (call.new_state.empty()) continue;
      store(call.new_state, n, i, h);
      store(call.new_state.subspan(6 * n), n, i, now);
    }
    return {};
  }

  void remember_step(const AxisStep& step) const override {
    if (!step.timed) return;
    const std::size_t n = step.width;
    const double* const c = step.c;
    double* const g = step.gradient;
    // g'_a = g_a − ⅓ (Σ_b g_b c_b)/c_a, half of Dev S. A branch beside others finds that of the elastic response in the
    // state of its neighbour, which has taken its step.
    const double* const elastic = beside_ != nullptr ? step.state - (own_axis_history - 3) * n : nullptr;
    const double work = (g[0] * c[0] + g[n] * c[n] + g[2 * n] * c[2 * n]) / 3;
    const std::array<double, 3> inverse{1 / c[0], 1 / c[n], 1 / c[2 * n]};
    const Relaxation unit(step.time_step, 1, step.parameters[1]);
    const Relaxation relaxation(unit.decay, step.parameters[0] * unit.slope);
    std::array<double, 3> change, faded;
    for (std::size_t a = 0; a < 3; ++a) {
      double* const h = step.state + a * n;
      double* const before = step.state + (3 + a) * n;
      const double now = elastic != nullptr ? elastic[a * n] : g[a * n] - work * inverse[a];
      change[a] = now - before[0];
      faded[a] = h[0];
      before[0] = now;
      h[0] = step.at_rest ? 0 : relaxation.decay * faded[a] + relaxation.slope * change[a];
    }
    for (std::size_t k = 1; k < n; ++k) {
      double work_k = 0;
      for (std::size_t a = 0; a < 3; ++a) work_k += g[a * n + k] * c[a * n] + g[a * n] * c[a * n + k];
      work_k /= 3;
      for (std::size_t a = 0; a < 3; ++a) {
        double& h = step.state[a * n + k];
        double& before = step.state[(3 + a) * n + k];
        const double now = elastic != nullptr ? elastic[a * n + k]
                                              : g[a * n + k] - (work_k - work * c[a * n + k] * inverse[a]) * inverse[a];
        if (!step.at_rest) h = relaxation.decay * h + relaxation.slope * (now - before);
        before = now;
      }
    }
    if (step.at_rest) return;
    if (step.parameter_place > 0) {
      // ∂h₊/∂g = φ Δg',  ∂h₊/∂τ = (x/τ) e^{−x} h − g (e^{−x} − φ)/τ Δg' with x = Δt/τ
      const double tau = step.parameters[1], x = step.time_step / tau;
      for (std::size_t a = 0; a < 3; ++a) {
        double* const h = step.state + a * n + step.parameter_place;
        h[0] += unit.slope * change[a];
        h[1] += (x * unit.decay * faded[a] - step.parameters[0] * (unit.decay - unit.slope) * change[a]) / tau;
      }
    }
    for (std::size_t k = 0; k < 3 * n; ++k) g[k] += step.state[k];
  }

  Status deviator_at_rest(std::span<const double> parameters, Tensor& rest) const {
    const Tensor identity{1, 1, 1, 0, 0, 0};
    Tensor S{};
    Status status = base().evaluate({1, identity, parameters, {}, {}}, {{}, S, {}, {}, {}});
    rest = deviator(S, identity, identity);
    return status;
  }

  /// What the model is that all branches stand beside, at the same step: the first parameters, and the first part of
  /// the state.
  Status evaluate_elastic(const MaterialPoints& points, std::span<double> stress, std::span<double> tangent) const {
    if (beside_ != nullptr && beside_->beside_ != nullptr) return beside_->evaluate_elastic(points, stress, tangent);
    const Model& elastic = beside_ != nullptr ? beside_->base() : base();
    const ModelDescription& description = elastic.describe();
    MaterialPoints own = points;
    own.parameters = points.parameters.first(description.parameters.size());
    if (!points.state.empty()) own.state = points.state.first(description.history_size * points.count);
    return elastic.evaluate(own, {{}, stress, tangent, {}, {}});
  }

  /// The tangent consistent with the step: A + g φ 2 ∂S'/∂C, with S' and its tangent of the elastic response.
  static void add_tangent(std::span<const double> elastic, std::span<double> tangent, std::size_t n, std::size_t i,
                          double slope, const Tensor& S, const Tensor& C, const Tensor& C_inverse) {
    Tangent A;
    for (std::size_t k = 0; k < 36; ++k) A[k] = elastic[k * n + i];
    const Tangent change = deviator_tangent(S, A, C, C_inverse);
    for (std::size_t k = 0; k < 36; ++k) tangent[k * n + i] += slope * change[k];
  }

  const ViscoelasticModel* beside_;  ///< the branch that this one stands beside; null = the first
};

MechanismFactory factory() {
  MechanismFactory mechanism{
      .id = "viscoelasticity",
      .cause = "Part of the stress relaxes with time: the tissue was pulled faster than it comes to equilibrium.",
      .stage = tunica::Stage::history,
      .parameters = own_parameters(),
      .null = 0,
      .side = MechanismFactory::Side::positive,
      .plausible_min = 0,
      .plausible_max = 3,
      .look_alikes = {"stress_softening", "signal_drift", "force_scale_error"},
      .isolated_by = "a hold at constant stretch, or a second rate",
      .reference =
          "Simo, Comput. Methods Appl. Mech. Eng. 60:153 (1987); Holzapfel, Nonlinear Solid Mechanics (2000), "
          "section 6.10",
      .several = true};
  mechanism.wrap_model = [](std::unique_ptr<Model> base, const Options&) -> std::unique_ptr<Model> {
    return std::make_unique<ViscoelasticModel>(std::move(base));
  };
  return mechanism;
}

}  // namespace
}  // namespace tunica::viscoelasticity

TUNICA_PLUGIN("viscoelasticity", TUNICA_PLUGIN_VERSION) { registry.add(tunica::viscoelasticity::factory()); }
