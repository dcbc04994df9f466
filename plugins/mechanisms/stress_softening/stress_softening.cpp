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

#include "tunica/models/history_model.hpp"
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

/// State: Wmax; in principal axes W at rest and Wmax. The energy it returns is that of the base, with which Wmax is
/// compared.
class SoftenedModel final : public HistoryModel {
 public:
  explicit SoftenedModel(std::unique_ptr<Model> base)
      : HistoryModel("stress_softening", std::move(base), own_parameters(), 1, 2) {}

 private:
  Status evaluate_step(Step& step) const override {
    const MaterialPoints& points = step.base_points;
    MaterialResponse& out = step.base_response;
    const std::size_t n = points.count;
    const double s = step.parameters[0], m = step.parameters[1];
    const bool tangent = !out.tangent.empty();
    // Points at rest are on their first path: nothing is soft yet.
    const bool soft = s != 0 && !step.old_state.empty() && (tangent || !out.stress.empty());
    if (!soft && step.new_state.empty()) return base().evaluate(points, out);

    std::vector<double> energy, stress;
    if (out.energy.empty()) {
      energy.resize(n);
      out.energy = energy;
    }
    if (soft && out.stress.empty()) {
      stress.resize(6 * n);
      out.stress = stress;
    }
    if (Status status = base().evaluate(points, out); !status.ok()) return status;
    double at_rest = 0;
    if (Status status = energy_at_rest(points.parameters, at_rest); !status.ok()) return status;
    std::vector<double> conservative;
    std::span<const double> by_energy = out.stress;
    if (soft && tangent && base().describe().history_size > 0) {
      conservative.resize(6 * n);
      by_energy = conservative;
      if (Status status = base().evaluate({n, points.C, points.parameters, {}, {}}, {{}, conservative, {}, {}, {}});
          !status.ok())
        return status;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double W = out.energy[i] - at_rest, before = step.old_state.empty() ? 0 : step.old_state[i];
      if (soft && before > unloaded * largest_stress(out.stress, n, i))
        soften(Softening(W, before, s, m), n, i, by_energy, out);
      if (!step.new_state.empty()) step.new_state[i] = std::isnan(W) ? W : std::max(before, W);
    }
    return {};
  }

  void remember_step(const AxisStep& step) const override {
    const std::size_t n = step.width;
    double* const at_rest = step.state;
    double* const largest = step.state + n;
    if (step.at_rest) {
      std::copy_n(step.energy, n, at_rest);
      return;
    }
    const double W = step.energy[0] - at_rest[0];
    const double* const g = step.gradient;
    const double stress = 2 * std::max({std::abs(g[0]), std::abs(g[n]), std::abs(g[2 * n])});
    const bool below = !step.first && W < largest[0];
    if (below && largest[0] > unloaded * stress) {
      soften(step, W);
    } else if (!below && (W > 0 || std::isnan(W))) {
      for (std::size_t k = 0; k < n; ++k) largest[k] = step.energy[k] - at_rest[k];
    }
  }

  /// g → η g with all derivatives. With x = (Wmax − W)/(m Wmax) and e = 2/√π e^{−x²},
  ///
  ///   dη = −erf(x) ds − s e dx,   dx = (dWmax − dW)/(m Wmax) − x (dWmax/Wmax + dm/m).
  static void soften(const AxisStep& step, double W) {
    const std::size_t n = step.width;
    const double* const at_rest = step.state;
    const double* const largest = step.state + n;
    const double s = step.parameters[0], m = step.parameters[1];
    const double width = m * largest[0], x = (largest[0] - W) / width, lost = std::erf(x);
    const double by_x = -s * 2 * std::numbers::inv_sqrtpi * std::exp(-x * x);
    const double by_energy = -by_x / width, by_largest = by_x * (1 / width - x / largest[0]);
    const double eta = 1 - s * lost;
    for (std::size_t a = 0; a < 3; ++a) {
      double* const g = step.gradient + a * n;
      const double bare = g[0];
      for (std::size_t k = 1; k < n; ++k)
        g[k] = eta * g[k] + bare * (by_energy * (step.energy[k] - at_rest[k]) + by_largest * largest[k]);
      g[0] = eta * bare;
      if (step.parameter_place == 0) continue;
      g[step.parameter_place] -= lost * bare;
      g[step.parameter_place + 1] -= by_x * x / m * bare;
    }
  }

  Status energy_at_rest(std::span<const double> parameters, double& W) const {
    const double identity[] = {1, 1, 1, 0, 0, 0};
    return base().evaluate({1, identity, parameters, {}, {}}, {{&W, 1}, {}, {}, {}, {}});
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
};

MechanismFactory factory() {
  MechanismFactory mechanism{
      .id = "stress_softening",
      .cause = "The tissue is softer where it has been loaded further before: it unloads along another curve.",
      .stage = tunica::Stage::history,
      .parameters = own_parameters(),
      .null = 0,
      .side = MechanismFactory::Side::positive,
      .plausible_min = 0,
      .plausible_max = 0.8,
      .look_alikes = {"viscoelasticity", "signal_drift"},
      .isolated_by = "a second loading to the same stretch, and one beyond it",
      .reference = "Ogden, Roxburgh, Proc. R. Soc. A 455:2861 (1999)",
      .scan = {{{"m", 0.1}}, {{"m", 0.5}}, {{"m", 2}}}};
  mechanism.wrap_model = [](std::unique_ptr<Model> base, const Options&) -> std::unique_ptr<Model> {
    return std::make_unique<SoftenedModel>(std::move(base));
  };
  return mechanism;
}

}  // namespace
}  // namespace tunica::stress_softening

TUNICA_PLUGIN("stress_softening", TUNICA_PLUGIN_VERSION) { registry.add(tunica::stress_softening::factory()); }
