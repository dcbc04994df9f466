// SPDX-License-Identifier: Apache-2.0
// The Mullins effect by a pseudo-energy (Ogden, Roxburgh 1999, Proc. R. Soc. A 455:2861): the stress of the base times
//
//   η = 1 − s erf((Wmax − W)/(m Wmax)),
//
// W the energy of the base counted from the unloaded state, Wmax the largest so far. On a path that has never been
// further η is 1, and the stress that of the base. The width of the error function is relative to Wmax here, so that m
// has no unit. The factor also multiplies whatever pressure the energy carries, which the pressure of an incompressible
// material takes up. Order of rows is enough, time is not needed.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "tunica/plugin.hpp"

namespace tunica::stress_softening {
namespace {

std::vector<Parameter> own_parameters() {
  const char* const source = "Ogden, Roxburgh 1999";
  return {{"s", "1", 0.2, 0, 1, Scale::linear, "Largest share of the stress that can be lost.", source},
          {"m", "1", 0.5, 0.01, 10, Scale::log,
           "Part of the largest energy, by which the material has to be unloaded to lose 84 % of that share.", source}};
}

/// Nothing has been stored yet where the largest energy is below this part of the stress: strains below 1e-6, which
/// rounding of the energy would take for a memory.
constexpr double unloaded = 1e-12;

/// η and dη/dW, at energy W where the largest of earlier points was `largest`.
struct Softening {
  double eta = 1, slope = 0;
  Softening(double W, double largest, double s, double m) {
    if (!(W < largest)) return;
    const double width = m * largest, x = (largest - W) / width;
    eta = 1 - s * std::erf(x);
    slope = s * std::numbers::inv_sqrtpi * 2 * std::exp(-x * x) / width;
  }
};

/// State: the base's, then Wmax. No exact parameter derivatives: the host differences paths. The energy answered is
/// that of the base, which is what Wmax is compared with.
class Softened final : public Model {
 public:
  explicit Softened(std::unique_ptr<Model> base) : base_(std::move(base)), description_(base_->describe()) {
    for (Parameter& parameter : own_parameters()) description_.parameters.push_back(std::move(parameter));
    description_.history_size += 1;
    description_.principal_axes = false;
    description_.parameter_derivatives = false;
  }

  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  [[nodiscard]] std::span<const std::unique_ptr<EnergyPart>> parts() const override { return base_->parts(); }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    if (!response.stress_dp.empty())
      return Status::failed("stress_softening: no parameter derivatives at a single step; difference the whole path");
    const std::size_t n = points.count, own = points.parameters.size() - 2;
    const double s = points.parameters[own], m = points.parameters[own + 1];
    const std::size_t base_state = n * base_->describe().history_size;
    MaterialPoints bare = points;
    bare.parameters = points.parameters.first(own);
    bare.state = points.state.first(points.state.empty() ? 0 : base_state);
    MaterialResponse out = response;
    out.state = response.state.first(response.state.empty() ? 0 : base_state);
    // Points at rest are on their first path: nothing is soft yet.
    const bool soft = s != 0 && !points.state.empty() && !(response.stress.empty() && response.tangent.empty());
    if (!soft && response.state.empty()) return base_->evaluate(bare, out);

    std::vector<double> energy, stress;
    if (response.energy.empty()) energy.resize(n), out.energy = energy;
    if (soft && response.stress.empty()) stress.resize(6 * n), out.stress = stress;
    if (Status status = base_->evaluate(bare, out); !status.ok()) return status;
    double at_rest = 0;
    if (Status status = energy_at_rest(bare.parameters, at_rest); !status.ok()) return status;
    std::vector<double> conservative;
    std::span<const double> by_energy = out.stress;
    if (soft && !response.tangent.empty() && base_->describe().history_size > 0) {
      conservative.resize(6 * n), by_energy = conservative;
      if (Status status = base_->evaluate({n, bare.C, bare.parameters, {}, {}}, {{}, conservative, {}, {}, {}});
          !status.ok())
        return status;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double W = out.energy[i] - at_rest, before = points.state.empty() ? 0 : points.state[base_state + i];
      if (soft && before > unloaded * largest_stress(out.stress, n, i))
        soften(Softening(W, before, s, m), n, i, by_energy, out);
      if (!response.state.empty()) response.state[base_state + i] = std::isnan(W) ? W : std::max(before, W);
    }
    return {};
  }

 private:
  Status energy_at_rest(std::span<const double> parameters, double& W) const {
    const double identity[] = {1, 1, 1, 0, 0, 0};
    return base_->evaluate({1, identity, parameters, {}, {}}, {{&W, 1}, {}, {}, {}, {}});
  }

  static double largest_stress(std::span<const double> stress, std::size_t n, std::size_t i) {
    return std::max({std::abs(stress[i]), std::abs(stress[n + i]), std::abs(stress[2 * n + i])});
  }

  /// S → η S, and the tangent consistent with it: η A + S ⊗ 2 ∂η/∂C = η A + η' S ⊗ S_W with S_W = 2 ∂W/∂C, which is S
  /// itself where the base has no memory.
  static void soften(const Softening& softening, std::size_t n, std::size_t i, std::span<const double> by_energy,
                     const MaterialResponse& out) {
    if (softening.eta == 1 && softening.slope == 0) return;
    for (std::size_t a = 0; a < (out.tangent.empty() ? 0 : 6); ++a) {
      for (std::size_t b = 0; b < 6; ++b) {
        double& entry = out.tangent[(6 * a + b) * n + i];
        entry = softening.eta * entry + softening.slope * out.stress[a * n + i] * by_energy[b * n + i];
      }
    }
    // The stress last: where the base has no memory, `by_energy` is it.
    for (std::size_t a = 0; a < 6; ++a) out.stress[a * n + i] *= softening.eta;
  }

  std::unique_ptr<Model> base_;
  ModelDescription description_;
};

MechanismFactory factory() {
  MechanismFactory mechanism{
      .id = "stress_softening",
      .cause = "The tissue is softer where it has been loaded further before: it unloads along another curve.",
      .stage = tunica::Stage::history,
      .applies_to = {},
      .parameters = own_parameters(),
      .null = 0,
      .side = MechanismFactory::Side::positive,
      .plausible_min = 0,
      .plausible_max = 0.8,
      .look_alikes = {"viscoelasticity", "signal_drift"},
      .isolated_by = "a second loading to the same stretch, and one beyond it",
      .reference = "Ogden, Roxburgh, Proc. R. Soc. A 455:2861 (1999)",
      .options = {},
      .scan = {{{"m", 0.1}}, {{"m", 0.5}}, {{"m", 2}}}};
  mechanism.wrap_model = [](std::unique_ptr<Model> base, const Options&) -> std::unique_ptr<Model> {
    return std::make_unique<Softened>(std::move(base));
  };
  return mechanism;
}

}  // namespace
}  // namespace tunica::stress_softening

TUNICA_PLUGIN("stress_softening", TUNICA_PLUGIN_VERSION) { registry.add(tunica::stress_softening::factory()); }
