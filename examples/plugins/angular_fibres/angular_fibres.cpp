// SPDX-License-Identifier: Apache-2.0
// Fibres in all directions of the plane of a layer, summed over angles (Lanir 1983, J. Biomech. 16:1–12), about two
// mean directions ±θ with the density of von Mises (Gasser, Ogden, Holzapfel 2006, J. R. Soc. Interface 3:15–35,
// eq. 4.1),
//
//   W = μ/2 (I1 − 3) + Σ_i w_i ψ(e_i),   ψ = k1/(2 k2) (exp(k2 e²) − 1) if e > 0,   e_i = M_i·C M_i − 1,
//   w_i = u_i / Σ_k u_k,   u_i = exp(b cos 2(φ_i − θ)) + exp(b cos 2(φ_i + θ)),
//
// with M_i at φ_i from axial. The weights depend on θ and b only. They are made once for a set of parameters.
#include <array>
#include <cmath>
#include <numbers>

#include "tunica/models/arterial_fibres.hpp"
#include "tunica/models/once_per_parameters.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
enum { mu, k1, k2, theta, b, parameter_count };
constexpr std::size_t angles = 24;

/// Over the half circle: M⊗M of each direction in tt, zz and tz, and w with its derivatives by θ (degrees) and b.
struct Weights {
  std::array<std::array<double, 3>, angles> dyad;
  std::array<double, angles> w, by_theta, by_b;
  explicit Weights(std::span<const double> p) {
    double sum = 0, sum_theta = 0, sum_b = 0;
    for (std::size_t i = 0; i < angles; ++i) {
      const double phi = std::numbers::pi * static_cast<double>(i) / angles, s = std::sin(phi), c = std::cos(phi);
      dyad[i] = {s * s, c * c, s * c};
      w[i] = by_theta[i] = by_b[i] = 0;
      for (const double side : {1.0, -1.0}) {
        const double turn = 2 * (phi - side * p[theta] * degree), u = std::exp(p[b] * (std::cos(turn) - 1));
        w[i] += u;
        by_theta[i] += u * p[b] * std::sin(turn) * 2 * side * degree;
        by_b[i] += u * (std::cos(turn) - 1);
      }
      sum += w[i], sum_theta += by_theta[i], sum_b += by_b[i];
    }
    for (std::size_t i = 0; i < angles; ++i) {
      w[i] /= sum;
      by_theta[i] = (by_theta[i] - w[i] * sum_theta) / sum;
      by_b[i] = (by_b[i] - w[i] * sum_b) / sum;
    }
  }
};

class AngularFibres final : public Model {
 public:
  AngularFibres() {
    const char* const source = "Gasser, Ogden, Holzapfel 2006";
    description_.type = "angular_fibres";
    description_.parameters = {arterial::mu(),
                               arterial::k1(),
                               arterial::k2(),
                               arterial::theta(),
                               {"b", "1", 3, 0.05, 30, Scale::log, "Concentration about the mean directions.", source}};
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const auto weights = weights_(points.parameters);
    const std::span<const double> p = points.parameters;
    const std::size_t n = points.count;
    for (const auto& values : {out.energy, out.stress, out.tangent, out.stress_dp}) std::ranges::fill(values, 0.0);
    const auto C = [&](std::size_t c, std::size_t i) { return points.C[c * n + i]; };
    for (std::size_t i = 0; i < n; ++i) {
      if (!out.energy.empty()) out.energy[i] = p[mu] / 2 * (C(0, i) + C(1, i) + C(2, i) - 3);
      for (std::size_t c = 0; c < 3; ++c) {
        if (!out.stress.empty()) out.stress[c * n + i] = p[mu];
        if (!out.stress_dp.empty()) out.stress_dp[(6 * mu + c) * n + i] = 1;
      }
      for (std::size_t k = 0; k < angles; ++k) {
        const auto [tt, zz, tz] = weights->dyad[k];
        const double e = tt * C(0, i) + zz * C(1, i) + 2 * tz * C(3, i) - 1, w = weights->w[k];
        if (!(e > 0)) continue;
        // ψ' = k1 e E and ψ'' = k1 (1 + 2 k2 e²) E, with E = exp(k2 e²)
        const double E = std::exp(p[k2] * e * e), slope = p[k1] * e * E, curve = p[k1] * (1 + 2 * p[k2] * e * e) * E;
        if (!out.energy.empty()) out.energy[i] += w * p[k1] / (2 * p[k2]) * (E - 1);
        const std::array<std::pair<std::size_t, double>, 3> M{{{0, tt}, {1, zz}, {3, tz}}};
        for (const auto& [c, m] : M) {  // S = 2 ψ' M, 2 ∂S/∂C = 4 ψ'' M⊗M
          if (!out.stress.empty()) out.stress[c * n + i] += 2 * w * slope * m;
          for (const auto& [d, of_d] : M)
            if (!out.tangent.empty()) out.tangent[(6 * c + d) * n + i] += 4 * w * curve * m * of_d;
          if (out.stress_dp.empty()) continue;
          const auto by = [&](std::size_t j, double change) { out.stress_dp[(6 * j + c) * n + i] += 2 * change * m; };
          by(k1, w * e * E);
          by(k2, w * slope * e * e);
          by(theta, weights->by_theta[k] * slope);
          by(b, weights->by_b[k] * slope);
        }
      }
    }
    return {};
  }

 private:
  OncePerParameters<Weights> weights_{[](std::span<const double> p) { return Weights(p); }};
  ModelDescription description_;
};

}  // namespace

TUNICA_PLUGIN("angular_fibres", "1.0.0") {
  registry.add(
      ModelFactory{"angular_fibres",
                   "Fibres summed over the angles of a plane about two mean directions, in a neo-Hookean matrix.",
                   "Lanir, J. Biomech. 16:1 (1983)",
                   {},
                   [](const Options&) { return std::make_unique<AngularFibres>(); }});
}
