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
#include <string>
#include <utility>
#include <vector>

#include "../damage/scaled_by_energy.hpp"
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

class SoftenedModel final : public ScaledByEnergy {
 public:
  explicit SoftenedModel(std::unique_ptr<Model> base)
      : ScaledByEnergy("stress_softening", std::move(base), own_parameters()) {}

 private:
  /// Points at rest are on their first path: nothing is soft yet.
  [[nodiscard]] bool scales(const Step& step) const override {
    return step.parameters[0] != 0 && !step.old_state.empty();
  }
  [[nodiscard]] Factor factor(std::span<const double> own, double W, double before, double stress) const override {
    if (!(before > unloaded * stress && W < before)) return {};
    const double s = own[0], width = own[1] * before, x = (before - W) / width;
    return {1 - s * std::erf(x), s * std::numbers::inv_sqrtpi * 2 * std::exp(-x * x) / width};
  }

  /// With x = (Wmax − W)/(m Wmax) and e = 2/√π e^{−x²}:  dη = −erf(x) ds − s e dx,
  ///   dx = (dWmax − dW)/(m Wmax) − x (dWmax/Wmax + dm/m).
  void scale_rows(std::span<const double> own, const ScaledPath& path, const Factors& out) const override {
    const std::size_t n = path.energy.size();
    const double s = own[0], m = own[1];
    double largest = 0;
    std::size_t row = n;
    for (std::size_t i = 0; i < n; ++i) {
      const double W = path.energy[i];
      const bool below = i > 0 && W < largest;
      if (!below && (W > 0 || std::isnan(W))) {
        largest = W;
        row = i;
      }
      out.largest[i] = row;
      double lost = 0, by_x = 0, x = 0, width = 1;
      if (below && largest > unloaded * path.stress[i]) {
        width = m * largest;
        x = (largest - W) / width;
        lost = std::erf(x);
        by_x = -s * 2 * std::numbers::inv_sqrtpi * std::exp(-x * x);
      }
      out.eta[i] = 1 - s * lost;
      out.by_energy[i] = -by_x / width;
      out.by_largest[i] = by_x == 0 ? 0 : by_x * (1 / width - x / largest);
      if (out.by_own.empty()) continue;
      out.by_own[i] = -lost;
      out.by_own[n + i] = -by_x * x / m;
    }
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
  // η = 1 − s erf((Wmax − W)/(m Wmax)): r = 1/s, and the width has no part of its own
  mechanism.card_softening = [](const Options&, std::span<const double> p) -> CardSoftening {
    if (!(p[0] > 0))
      throw InputError(
          "stress_softening: at s = 0 nothing softens, and cards have no such law; fit without the mechanism");
    if (!(p[0] < 1)) throw InputError("stress_softening: at s = 1 all is lost, and cards need less; hold s below 1");
    return {1 / p[0], 0, p[1]};
  };
  return mechanism;
}

}  // namespace
}  // namespace tunica::stress_softening

TUNICA_PLUGIN("stress_softening", TUNICA_PLUGIN_VERSION) { registry.add(tunica::stress_softening::factory()); }
