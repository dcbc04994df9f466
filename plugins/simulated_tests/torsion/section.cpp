// SPDX-License-Identifier: Apache-2.0
#include "section.hpp"

#include <algorithm>
#include <numbers>

namespace tunica::torsion {

Section::Section(const Model& model, std::span<const double> parameters, double outer, int points)
    : model_(model), parameters_(parameters), outer_(outer), rule_(points) {
  const std::size_t n = rule_.node.size();
  C_.resize(6 * n);
  S_.resize(6 * n);
  A_.resize(36 * n);
  C_jet_.resize(n);
  r2_.resize(n);
  R2_.resize(n);
}

bool Section::evaluate(const std::array<double, variable_count>& at, bool by_parameters) {
  const std::size_t n = rule_.node.size();
  for (int v = 0; v < variable_count; ++v)
    geometry_[static_cast<std::size_t>(v)] = Jet(at[static_cast<std::size_t>(v)], v);
  const Jet &lambda = geometry_[axial], &phi = geometry_[twist], &Ri = geometry_[inner];
  const bool solid = Ri.a == 0;
  const Jet area = outer_ * outer_ - Ri * Ri, ri2 = solid ? Jet(0) : exp(2.0 * geometry_[ln_inner]);
  for (std::size_t i = 0; i < n; ++i) {
    const Jet R2 = Ri * Ri + rule_.node[i] * area, r2 = ri2 + rule_.node[i] * area / lambda;
    std::array<Jet, 6>& C = C_jet_[i];
    C = {r2 / R2, lambda * lambda + r2 * phi * phi, R2 / (r2 * lambda * lambda), r2 * phi / sqrt(R2), Jet(0), Jet(0)};
    for (std::size_t c = 0; c < 6; ++c) C_[c * n + i] = C[c].a;
    r2_[i] = r2;
    R2_[i] = R2;
  }
  if (by_parameters) S_dp_.resize(6 * parameters_.size() * n);
  if (!model_.evaluate({n, C_, parameters_, {}, {}}, {{}, S_, A_, {S_dp_.data(), by_parameters ? S_dp_.size() : 0}, {}})
           .ok())
    return false;
  loads_ = integrate([&](std::size_t i) {
    std::array<Jet, 6> S;
    for (std::size_t a = 0; a < 6; ++a) {
      S[a] = Jet(S_[a * n + i]);
      // dS_a = ½ Σ_b (2 ∂S_a/∂C_b) dC_b; off-diagonal entries of C count twice.
      for (std::size_t b = 0; b < 4; ++b) S[a].v += (b < 3 ? 0.5 : 1.0) * A_[(6 * a + b) * n + i] * C_jet_[i][b].v;
    }
    return S;
  });
  return std::isfinite(loads_.pressure.a) && std::isfinite(loads_.force.a) && std::isfinite(loads_.torque.a) &&
         loads_.pressure.v.allFinite();
}

Loads Section::by_parameter(std::size_t j) const {
  const std::size_t n = rule_.node.size();
  return integrate([&](std::size_t i) {
    std::array<Jet, 6> S;
    for (std::size_t a = 0; a < 6; ++a) S[a] = Jet(S_dp_[(6 * j + a) * n + i]);
    return S;
  });
}

/// With x = R²: r dr = dx/(2 λz).
template <class Stress>
Loads Section::integrate(const Stress& stress) const {
  const Jet &lambda = geometry_[axial], &phi = geometry_[twist], &Ri = geometry_[inner];
  const Jet area = outer_ * outer_ - Ri * Ri;
  Loads sum{Jet(0), Jet(0), Jet(0)};
  for (std::size_t i = 0; i < rule_.node.size(); ++i) {
    const std::array<Jet, 6> S = stress(i);
    const std::array<Jet, 6>& C = C_jet_[i];
    const Jet r = sqrt(r2_[i]), tt = C[0] * S[0] + 2.0 * C[3] * S[3] + r2_[i] * phi * phi * S[1],
              zz = lambda * lambda * S[1], rr = C[2] * S[2], tz = lambda * r * (S[3] / sqrt(R2_[i]) + phi * S[1]);
    const Jet ring = rule_.weight[i] * area / (2.0 * lambda);
    sum.pressure += ring * (tt - rr) / r2_[i];
    sum.force += std::numbers::pi * ring * (2.0 * zz - tt - rr);
    sum.torque += 2.0 * std::numbers::pi * ring * r * tz;
  }
  return sum;
}

}  // namespace tunica::torsion
