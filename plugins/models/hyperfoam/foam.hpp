// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "tunica/models/principal_stretches.hpp"
#include "tunica/models/rubber_laws.hpp"
#include "tunica/models/volume_energy.hpp"

namespace tunica::foam {

/// One term 2μ/α² [Σ λ^α − 3 + (J^(−αβ) − 1)/β], β = ν/(1 − 2ν), and the model's parameters that it is made of.
struct Term {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  double mu = 0, alpha = 1, nu = 0;
  std::size_t mu_place = none, alpha_place = none, nu_place = none;  ///< of the parameter that it is
  /// Parameters that μ is a product of, and ∂μ/∂p; where it is none itself.
  std::array<std::pair<std::size_t, double>, 2> mu_factors{{{none, 0}, {none, 0}}};
};

/// The sum of the terms. The part with the stretches is Ogden's, whose own coefficient is 2μ/α.
template <std::size_t terms>
class Foam final : public Model {
 public:
  using Terms = std::function<std::array<Term, terms>(std::span<const double>)>;

  Foam(ModelDescription description, Terms make)
      : description_(std::move(description)), make_(std::move(make)), stretches_(of_stretches()) {
    description_.compressible = true;
    description_.principal_axes = true;
  }

  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const std::array<Term, terms> all = make_(points.parameters);
    const std::array<double, 2 * terms> ogden = of_ogden(all);
    const std::size_t n = points.count;
    std::vector<double> by_ogden(out.stress_dp.empty() ? 0 : 12 * terms * n);
    MaterialResponse response = out;
    response.stress_dp = by_ogden;
    if (Status status = stretches_.evaluate({n, points.C, ogden, {}, {}}, response); !status.ok()) return status;
    if (!out.stress_dp.empty()) chain(all, by_ogden, out.stress_dp, 6 * n);
    for (std::size_t i = 0; i < n; ++i) {
      VolumeEnergy::Tensor C;
      for (std::size_t c = 0; c < 6; ++c) C[c] = points.C[c * n + i];
      const VolumeEnergy volume(C);
      for (const Term& term : all) add(term, volume, out, n, i);
    }
    return {};
  }

  /// With g_a = ∂W/∂c_a: U_θ/(2 c_a) is added, and U_θθ/(4 c_a c_b) − δ_ab U_θ/(2 c_a²) to the second derivatives.
  Status evaluate_axes(const AxisPoints& points, const AxisResponse& out) const override {
    const std::array<Term, terms> all = make_(points.parameters);
    const std::array<double, 2 * terms> ogden = of_ogden(all);
    const std::size_t n = points.count;
    std::vector<double> by_ogden(out.gradient_dp.empty() ? 0 : 6 * terms * n);
    AxisResponse response = out;
    response.gradient_dp = by_ogden;
    response.energy_dp = {};
    if (Status status = stretches_.evaluate_axes({n, points.c, ogden}, response); !status.ok()) return status;
    if (!out.gradient_dp.empty()) chain(all, by_ogden, out.gradient_dp, 3 * n);
    constexpr std::array<std::array<std::size_t, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
    for (std::size_t i = 0; i < n; ++i) {
      const std::array<double, 3> c{points.c[i], points.c[n + i], points.c[2 * n + i]};
      const double theta = 0.5 * std::log(c[0] * c[1] * c[2]);
      for (const Term& term : all) {
        const VolumePart U(term, theta);
        if (!out.energy.empty()) out.energy[i] += U.energy;
        for (std::size_t a = 0; a < 3 && !out.gradient.empty(); ++a) out.gradient[a * n + i] += U.by_theta / (2 * c[a]);
        for (std::size_t k = 0; k < 6 && !out.hessian.empty(); ++k) {
          const auto [a, b] = pair[k];
          out.hessian[k * n + i] +=
              U.by_theta_twice / (4 * c[a] * c[b]) - (a == b ? U.by_theta / (2 * c[a] * c[a]) : 0);
        }
        if (out.gradient_dp.empty()) continue;
        const auto add = [&](std::size_t j, double by_p) {
          for (std::size_t a = 0; a < 3; ++a) out.gradient_dp[(3 * j + a) * n + i] += by_p / (2 * c[a]);
        };
        U.for_parameters(term, add);
      }
    }
    return {};
  }

 private:
  /// U = A (e^(−αβθ) − 1)/β with A = 2μ/α²: U_θ = −A α e, U_θθ = A α² β e; at β = 0, U = −A α θ.
  /// Derivatives of U_θ = −(2μ/α) e: by μ −2e/α, by α 2μ e/α² + (2μ/α) βθ e, by ν 2μ θ e dβ/dν, dβ/dν = 1/(1 − 2ν)².
  struct VolumePart {
    double energy, by_theta, by_theta_twice;
    VolumePart(const Term& term, double at) : theta(at) {
      left = 1 - 2 * term.nu;
      beta = term.nu / left;
      const double x = -term.alpha * beta * theta;
      e = std::exp(x);
      A = 2 * term.mu / (term.alpha * term.alpha);
      energy = std::abs(x) < 1e-12 ? -A * term.alpha * theta : A * std::expm1(x) / beta;
      by_theta = -A * term.alpha * e;
      by_theta_twice = A * term.alpha * term.alpha * beta * e;
    }
    /// add(j, ∂U_θ/∂p_j) for each of the parameters of the term.
    template <class Add>
    void for_parameters(const Term& term, const Add& add) const {
      for_mu(term, [&](std::size_t j, double factor) { add(j, -2 * factor * e / term.alpha); });
      if (term.alpha_place != Term::none) add(term.alpha_place, A * e * (1 + term.alpha * beta * theta));
      add(term.nu_place, 2 * term.mu * theta * e / (left * left));
    }

   private:
    double theta, left, beta, e, A;
  };

  static std::array<double, 2 * terms> of_ogden(const std::array<Term, terms>& all) {
    std::array<double, 2 * terms> ogden;
    for (std::size_t k = 0; k < terms; ++k) {
      ogden[2 * k] = 2 * all[k].mu / all[k].alpha;
      ogden[2 * k + 1] = all[k].alpha;
    }
    return ogden;
  }

  static PrincipalStretches<laws::Ogden<terms>> of_stretches() {
    ModelDescription description;
    description.type = "ogden";
    for (std::size_t k = 0; k < 2 * terms; ++k)
      description.parameters.push_back({std::to_string(k), "1", 1, -1e6, 1e6, Scale::linear, "", ""});
    return PrincipalStretches<laws::Ogden<terms>>(std::move(description));
  }

  static void add_to(std::span<double> derivatives, std::size_t j, double factor, const double* from,
                     std::size_t size) {
    for (std::size_t k = 0; k < size; ++k) derivatives[j * size + k] += factor * from[k];
  }
  /// ∂/∂μ with all that μ is made of.
  template <class Add>
  static void for_mu(const Term& term, const Add& add) {
    if (term.mu_place != Term::none) add(term.mu_place, 1.0);
    for (const auto& [place, factor] : term.mu_factors)
      if (place != Term::none) add(place, factor);
  }

  /// With m = 2μ/α: ∂m/∂μ = 2/α, ∂m/∂α = −2μ/α². `size` numbers belong to one parameter.
  static void chain(const std::array<Term, terms>& all, const std::vector<double>& by_ogden,
                    std::span<double> derivatives, std::size_t size) {
    std::fill(derivatives.begin(), derivatives.end(), 0.0);
    for (std::size_t k = 0; k < terms; ++k) {
      const Term& term = all[k];
      const double *const by_m = &by_ogden[2 * k * size], *const by_alpha = by_m + size;
      for_mu(term, [&](std::size_t j, double factor) { add_to(derivatives, j, factor * 2 / term.alpha, by_m, size); });
      if (term.alpha_place == Term::none) continue;
      add_to(derivatives, term.alpha_place, -2 * term.mu / (term.alpha * term.alpha), by_m, size);
      add_to(derivatives, term.alpha_place, 1, by_alpha, size);
    }
  }

  static void add(const Term& term, const VolumeEnergy& volume, const MaterialResponse& out, std::size_t n,
                  std::size_t i) {
    const VolumePart U(term, volume.log_volume());
    volume.add(U.energy, U.by_theta, U.by_theta_twice, out, n, i);
    if (!out.stress_dp.empty())
      U.for_parameters(term, [&](std::size_t j, double by_p) { volume.add_parameter(j, by_p, out, n, i); });
  }

  ModelDescription description_;
  Terms make_;
  PrincipalStretches<laws::Ogden<terms>> stretches_;
};

}  // namespace tunica::foam
