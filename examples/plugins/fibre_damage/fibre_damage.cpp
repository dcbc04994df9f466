// SPDX-License-Identifier: Apache-2.0
// Fibres that are damaged by what they have borne: the model of Gasser, Ogden, Holzapfel (2006) without dispersion, its
// fibre energy ψ reduced by a discontinuous damage variable (Simo 1987, Comput. Methods Appl. Mech. Eng. 60:153–173;
// for arteries Balzani, Schröder, Gross 2006, Acta Biomater. 2:609–618),
//
//   S = S_matrix + (1 − D(β)) S_fibres,   β = max over the past of ψ,   D = d (1 − exp(−⟨β − ψ_c⟩/m)).
//
// Below ψ_c the fibres are undamaged. The state of a material point is β. The energy answered contains what damage has
// consumed, ∫ D'(b) b db, so that S stays its derivative, on loading and unloading alike.
#include <cmath>

#include "tunica/models/arterial_fibres.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
enum { mu, k1, k2, theta, d, psi_c, m, parameter_count };

/// D, D' and ∫_0^β D'(b) b db at β.
struct Damage {
  double value = 0, slope = 0, consumed = 0;
  Damage(double beta, std::span<const double> p) {
    if (!(beta > p[psi_c])) return;
    const double left = std::exp(-(beta - p[psi_c]) / p[m]);
    value = p[d] * (1 - left);
    slope = p[d] / p[m] * left;
    consumed = p[d] * (p[psi_c] + p[m] - (beta + p[m]) * left);
  }
};

ModelDescription description() {
  const std::string source = "Balzani, Schröder, Gross 2006";
  ModelDescription it;
  it.type = "fibre_damage";
  it.parameters = {arterial::mu(),
                   arterial::k1(),
                   arterial::k2(),
                   arterial::theta(),
                   {"d", "1", 0.5, 0, 0.99, Scale::linear, "Share of the fibres that can be lost.", source},
                   {"psi_c", "kPa", 1, 0.01, 100, Scale::log, "Energy of the fibres below which none is.", source},
                   {"m", "kPa", 5, 0.05, 500, Scale::log, "Energy over which damage builds up.", source}};
  return it;
}

class FibreDamage final : public Model {
 public:
  explicit FibreDamage(const Options& options)
      : matrix_(::description(), energy_parts(isotropic::neo_hookean<parameter_count>(mu))),
        fibres_(::description(), energy_parts(arterial::fibres<arterial::AlignedFibres<theta>, parameter_count>(
                                     {theta}, {k1, k2}, options))),
        description_(::description()) {
    description_.history_size = 1;
    description_.parameter_derivatives = false;  // β remembers other parameters' paths: the host differences whole ones
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    if (!out.stress_dp.empty()) return Status::failed("fibre_damage: no parameter derivatives at a single step");
    const std::size_t n = points.count;
    std::vector<double> psi(n), S(6 * n), A(out.tangent.empty() ? 0 : 36 * n);
    if (Status status = fibres_.evaluate(points, {psi, S, A, {}, {}}); !status.ok()) return status;
    if (Status status = matrix_.evaluate(points, {out.energy, out.stress, out.tangent, {}, {}}); !status.ok())
      return status;
    for (std::size_t i = 0; i < n; ++i) {
      const double old = points.state.empty() ? 0 : points.state[i], beta = std::max(old, psi[i]);
      const Damage damage(beta, points.parameters);
      const double left = 1 - damage.value, growth = psi[i] > old ? damage.slope : 0;
      if (!out.energy.empty()) out.energy[i] += left * psi[i] + damage.consumed;
      for (std::size_t c = 0; !out.stress.empty() && c < 6; ++c) out.stress[c * n + i] += left * S[c * n + i];
      // 2 ∂S/∂C = … + (1 − D) A − D' S ⊗ S, since 2 ∂ψ/∂C = S
      for (std::size_t k = 0; !out.tangent.empty() && k < 36; ++k)
        out.tangent[k * n + i] += left * A[k * n + i] - growth * S[k / 6 * n + i] * S[k % 6 * n + i];
      if (!out.state.empty()) out.state[i] = beta;
    }
    return {};
  }

 private:
  Hyperelastic matrix_, fibres_;
  ModelDescription description_;
};

}  // namespace

TUNICA_PLUGIN("fibre_damage", "1.0.0") {
  registry.add(ModelFactory{"fibre_damage",
                            "Two fibre families that are damaged by overload, in a neo-Hookean matrix.",
                            "Balzani, Schröder, Gross, Acta Biomater. 2:609 (2006)",
                            {arterial::fibre_switch()},
                            [](const Options& options) { return std::make_unique<FibreDamage>(options); }});
}
