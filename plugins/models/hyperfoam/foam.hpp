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
  }

  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const std::array<Term, terms> all = make_(points.parameters);
    std::array<double, 2 * terms> ogden;
    for (std::size_t k = 0; k < terms; ++k) {
      ogden[2 * k] = 2 * all[k].mu / all[k].alpha;
      ogden[2 * k + 1] = all[k].alpha;
    }
    const std::size_t n = points.count;
    std::vector<double> by_ogden(out.stress_dp.empty() ? 0 : 12 * terms * n);
    MaterialResponse response = out;
    response.stress_dp = by_ogden;
    if (Status status = stretches_.evaluate({n, points.C, ogden, {}, {}}, response); !status.ok()) return status;
    if (!out.stress_dp.empty()) chain(all, by_ogden, out.stress_dp, n);
    for (std::size_t i = 0; i < n; ++i) {
      VolumeEnergy::Tensor C;
      for (std::size_t c = 0; c < 6; ++c) C[c] = points.C[c * n + i];
      const VolumeEnergy volume(C);
      for (const Term& term : all) add(term, volume, out, n, i);
    }
    return {};
  }

 private:
  static PrincipalStretches<laws::Ogden<terms>> of_stretches() {
    ModelDescription description;
    description.type = "ogden";
    for (std::size_t k = 0; k < 2 * terms; ++k)
      description.parameters.push_back({std::to_string(k), "1", 1, -1e6, 1e6, Scale::linear, "", ""});
    return PrincipalStretches<laws::Ogden<terms>>(std::move(description));
  }

  static void add_to(std::span<double> stress_dp, std::size_t j, double factor, const double* from, std::size_t n) {
    for (std::size_t k = 0; k < 6 * n; ++k) stress_dp[6 * j * n + k] += factor * from[k];
  }
  /// ∂/∂μ with all that μ is made of.
  template <class Add>
  static void for_mu(const Term& term, const Add& add) {
    if (term.mu_place != Term::none) add(term.mu_place, 1.0);
    for (const auto& [place, factor] : term.mu_factors)
      if (place != Term::none) add(place, factor);
  }

  /// With m = 2μ/α: ∂m/∂μ = 2/α, ∂m/∂α = −2μ/α².
  static void chain(const std::array<Term, terms>& all, const std::vector<double>& by_ogden,
                    std::span<double> stress_dp, std::size_t n) {
    std::fill(stress_dp.begin(), stress_dp.end(), 0.0);
    for (std::size_t k = 0; k < terms; ++k) {
      const Term& term = all[k];
      const double *const by_m = &by_ogden[12 * k * n], *const by_alpha = by_m + 6 * n;
      for_mu(term, [&](std::size_t j, double factor) { add_to(stress_dp, j, factor * 2 / term.alpha, by_m, n); });
      if (term.alpha_place == Term::none) continue;
      add_to(stress_dp, term.alpha_place, -2 * term.mu / (term.alpha * term.alpha), by_m, n);
      add_to(stress_dp, term.alpha_place, 1, by_alpha, n);
    }
  }

  /// U = A (e^(−αβθ) − 1)/β with A = 2μ/α²: U_θ = −A α e, U_θθ = A α² β e; at β = 0, U = −A α θ.
  /// Derivatives of U_θ = −(2μ/α) e: by μ −2e/α, by α 2μ e/α² + (2μ/α) βθ e, by ν 2μ θ e dβ/dν, dβ/dν = 1/(1 − 2ν)².
  static void add(const Term& term, const VolumeEnergy& volume, const MaterialResponse& out, std::size_t n,
                  std::size_t i) {
    const double left = 1 - 2 * term.nu, beta = term.nu / left, theta = volume.log_volume();
    const double x = -term.alpha * beta * theta, e = std::exp(x), A = 2 * term.mu / (term.alpha * term.alpha);
    const double energy = std::abs(x) < 1e-12 ? -A * term.alpha * theta : A * std::expm1(x) / beta;
    volume.add(energy, -A * term.alpha * e, A * term.alpha * term.alpha * beta * e, out, n, i);
    if (out.stress_dp.empty()) return;
    for_mu(term,
           [&](std::size_t j, double factor) { volume.add_parameter(j, -2 * factor * e / term.alpha, out, n, i); });
    if (term.alpha_place != Term::none)
      volume.add_parameter(term.alpha_place, A * e * (1 + term.alpha * beta * theta), out, n, i);
    volume.add_parameter(term.nu_place, 2 * term.mu * theta * e / (left * left), out, n, i);
  }

  ModelDescription description_;
  Terms make_;
  PrincipalStretches<laws::Ogden<terms>> stretches_;
};

}  // namespace tunica::foam
