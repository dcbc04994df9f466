// SPDX-License-Identifier: Apache-2.0
// Discontinuous damage: what was torn stays torn, and nothing more tears below the largest load so far. The stress of
// the base times
//
//   η = 1 − d (1 − exp(−(Wmax/w)^m)),
//
// W the energy of the base counted from the unloaded state, Wmax the largest so far, that of the row included. m = 1 is
// the exponential law of Simo (Comput. Methods Appl. Mech. Eng. 60:153, 1987) in the form of Miehe (Eur. J. Mech. A
// 14:697, 1995). d = 1 with a larger m softens to failure, as an energy limiter does (Volokh, J. Mech. Phys. Solids
// 55:2237, 2007), and does not heal. Unlike `stress_softening`, the first loading is softer too, and unloading and
// reloading are one curve. Order of rows is enough, time is not needed.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "scaled_by_energy.hpp"
#include "tunica/plugin.hpp"

namespace tunica::damage {
namespace {

std::vector<Parameter> parameters_of(bool to_failure) {
  const char* const source = "Miehe 1995";
  std::vector<Parameter> own{
      {"d", "1", to_failure ? 1 : 0.3, 0, 1, Scale::linear, "Largest share of the stress that is lost.", source},
      {"w", "kPa", 10, 0.001, 1e6, Scale::log, "Energy at which 63 % of that share are lost.", source}};
  if (to_failure) own.push_back({"m", "1", 2, 1, 50, Scale::log, "How suddenly the material fails.", "Volokh 2007"});
  return own;
}

/// d, w, m of a call.
struct Law {
  double d, w, m;
  explicit Law(std::span<const double> own) : d(own[0]), w(own[1]), m(own.size() > 2 ? own[2] : 1) {}

  [[nodiscard]] double x(double largest) const { return largest > 0 ? std::pow(largest / w, m) : 0; }
  [[nodiscard]] double eta(double largest) const { return 1 + d * std::expm1(-x(largest)); }
  /// dη/dWmax = −d e^{−x} m x/Wmax
  [[nodiscard]] double slope(double largest) const {
    const double left = std::exp(-x(largest));
    return largest > 0 && left != 0 ? -d * left * m * x(largest) / largest : 0;
  }
};

class DamagedModel final : public ScaledByEnergy {
 public:
  DamagedModel(std::unique_ptr<Model> base, bool to_failure)
      : ScaledByEnergy("damage", std::move(base), parameters_of(to_failure)) {}

 private:
  [[nodiscard]] bool scales(const Step& step) const override { return step.parameters[0] != 0; }
  [[nodiscard]] Factor factor(std::span<const double> own, double W, double before, double) const override {
    const Law law(own);
    const double largest = std::isnan(W) ? W : std::max(before, W);
    return {law.eta(largest), W > before ? law.slope(largest) : 0};
  }

  /// dη = −(1 − e^{−x}) dd − d e^{−x} dx,  dx = x (m dWmax/Wmax − m dw/w + ln(Wmax/w) dm): as long as Wmax stays, so
  /// does all of it.
  void scale_rows(std::span<const double> own, const ScaledPath& path, const Factors& out) const override {
    const std::size_t n = path.energy.size();
    const Law law(own);
    double largest = 0, x = 0, eta = law.eta(0), left = 1;
    std::size_t row = n;
    for (std::size_t i = 0; i < n; ++i) {
      if (const double W = path.energy[i]; W > largest || std::isnan(W)) {
        largest = W;
        row = i;
        x = law.x(largest);
        left = std::exp(-x);
        eta = 1 + law.d * std::expm1(-x);
      }
      const double moved = left == 0 ? 0 : -law.d * left * x;  // all is lost, however large x is
      out.largest[i] = row;
      out.eta[i] = eta;
      out.by_energy[i] = 0;
      out.by_largest[i] = row == n ? 0 : law.m * moved / largest;
      if (out.by_own.empty()) continue;
      out.by_own[i] = std::expm1(-x);
      out.by_own[n + i] = -moved * law.m / law.w;
      if (own.size() > 2) out.by_own[2 * n + i] = moved == 0 ? 0 : moved * std::log(largest / law.w);
    }
  }

  /// g → η g with all derivatives: dη = −(1 − e^{−x}) dd − d e^{−x} dx, dx = x (m dWmax/Wmax − m dw/w + ln(Wmax/w) dm).
  void remember_step(const AxisStep& step) const override {
    const std::size_t n = step.width;
    double* const at_rest = step.state;
    double* const largest = step.state + n;
    if (step.at_rest) {
      std::copy_n(step.energy, n, at_rest);
      return;
    }
    const double W = step.energy[0] - at_rest[0];
    if (W > largest[0] || std::isnan(W))
      for (std::size_t k = 0; k < n; ++k) largest[k] = step.energy[k] - at_rest[k];
    const Law law(step.parameters);
    const double x = law.x(largest[0]), eta = law.eta(largest[0]), slope = law.slope(largest[0]);
    const double left = std::exp(-x), moved = left == 0 ? 0 : -law.d * left * x;
    for (std::size_t a = 0; a < 3; ++a) {
      double* const g = step.gradient + a * n;
      const double bare = g[0];
      for (std::size_t k = 1; k < n; ++k) g[k] = eta * g[k] + bare * slope * largest[k];
      g[0] = eta * bare;
      if (step.parameter_place == 0 || x == 0) continue;
      double* const own = g + step.parameter_place;
      own[0] += std::expm1(-x) * bare;
      own[1] -= moved * law.m / law.w * bare;
      if (step.parameters.size() > 2 && moved != 0) own[2] += moved * std::log(largest[0] / law.w) * bare;
    }
  }
};

bool to_failure(const Options& options) { return options.text("law") == "failure"; }

MechanismFactory factory() {
  MechanismFactory mechanism{
      .id = "damage",
      .cause = "The material tears as it is loaded further than before, and stays softer.",
      .stage = tunica::Stage::history,
      .parameters = parameters_of(false),
      .parameters_of = [](const Options& options) { return parameters_of(to_failure(options)); },
      .null = 0,
      .side = MechanismFactory::Side::positive,
      .plausible_min = 0,
      .plausible_max = 0.9,
      .look_alikes = {"stress_softening", "permanent_set"},
      .isolated_by = "a second loading to the same stretch, and one beyond it",
      .reference = "Simo, Comput. Methods Appl. Mech. Eng. 60:153 (1987); Miehe, Eur. J. Mech. A 14:697 (1995)",
      .options = {Option::choice("law", {"discontinuous", "failure"}, "discontinuous",
                                 "How damage grows: to a limit, or, with one parameter more, to failure.")},
      .scan = {{{"w", 1}}, {{"w", 10}}, {{"w", 100}}}};
  mechanism.wrap_model = [](std::unique_ptr<Model> base, const Options& options) -> std::unique_ptr<Model> {
    return std::make_unique<DamagedModel>(std::move(base), to_failure(options));
  };
  return mechanism;
}

}  // namespace
}  // namespace tunica::damage

TUNICA_PLUGIN("damage", TUNICA_PLUGIN_VERSION) { registry.add(tunica::damage::factory()); }
