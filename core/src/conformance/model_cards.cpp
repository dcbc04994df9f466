// SPDX-License-Identifier: Apache-2.0
// Whether the energy that a model declares for material cards is its own, by the formulas of card_energy.hpp.
#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "conformance/differences.hpp"
#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"

namespace tunica::conformance {
namespace {

struct State {
  Matrix C;
  double I1, I2;
  Eigen::Vector3d stretches;

  explicit State(const Matrix& at)
      : C(at),
        I1(at.trace()),
        I2((at.trace() * at.trace() - (at * at).trace()) / 2),
        stretches(Eigen::SelfAdjointEigenSolver<Matrix>(at).eigenvalues().cwiseSqrt()) {}
  [[nodiscard]] double powers(double alpha) const { return stretches.array().pow(alpha).sum() - 3; }
};

// Σ C_mn (I1 − 3)^m (I2 − 3)^n
double energy_of(const PolynomialEnergy& card, const State& at) {
  double sum = 0;
  for (const auto& term : card.terms)
    sum += term.coefficient * std::pow(at.I1 - 3, term.m) * std::pow(at.I2 - 3, term.n);
  return sum;
}

// −μ Jm/2 ln(1 − (I1 − 3)/Jm)
double energy_of(const LimitedChainEnergy& card, const State& at) {
  return -card.mu * card.Jm / 2 * std::log1p(-(at.I1 - 3) / card.Jm);
}

// Σ μ/α (Σ λ^α − 3)
double energy_of(const StretchEnergy& card, const State& at) {
  double sum = 0;
  for (const auto& term : card.terms) sum += term.mu / term.alpha * at.powers(term.alpha);
  return sum;
}

// Σ 2μ/α² [Σ λ^α − 3 + (J^(−αβ) − 1)/β], and −α ln J in place of the last for ν = 0
double energy_of(const FoamEnergy& card, const State& at) {
  double sum = 0;
  for (const auto& term : card.terms) {
    const double beta = term.nu / (1 - 2 * term.nu), log_J = std::log(at.stretches.prod());
    const double volume = beta == 0 ? -term.alpha * log_J : std::expm1(-term.alpha * beta * log_J) / beta;
    sum += 2 * term.mu / (term.alpha * term.alpha) * (at.powers(term.alpha) + volume);
  }
  return sum;
}

// μ/2 (I1 − 3) + Σ k1/(2 k2) [exp(k2 E²) − 1],  E = A I1 + B M·CM + (1 − 3A − B) C_rr − 1
double energy_of(const FibreEnergy& card, const State& at) {
  double sum = card.mu / 2 * (at.I1 - 3);
  for (const FibreFamily& family : card.families) {
    const double angle = family.angle * std::numbers::pi / 180;
    const Eigen::Vector3d M(std::sin(angle), std::cos(angle), 0);
    const double along = M.dot(at.C * M);
    const double E = family.A * at.I1 + family.B * along + (1 - 3 * family.A - family.B) * at.C(2, 2) - 1;
    const bool acts = card.active == EnergyPart::Active::always ||
                      (card.active == EnergyPart::Active::argument_positive ? E > 0 : along > 1);
    if (acts) sum += family.k1 * E * E / 2 * (family.k2 == 0 ? 1 : std::expm1(family.k2 * E * E) / (family.k2 * E * E));
  }
  return sum;
}

}  // namespace

Verdict card_has_the_energy_of_the_model(const Model& model, const CardFormula& card, const Options& options,
                                         std::uint64_t seed) {
  Meter meter("W with that of the declared card, relative to the stress", 1e-8);
  Sampler sampler(seed);
  for (int draw = 0; draw < 40; ++draw) {
    Point point = sampler.point(model);
    Matrix C = to_matrix(point.C);
    if (!model.describe().compressible) C /= std::cbrt(C.determinant());
    point.C = to_tensor(C);
    const Evaluated at = evaluate(model, point.C, point.p);
    if (!at.finite()) continue;  // beyond a limit of extension, once the volume is kept
    const double rest = evaluate(model, {1, 1, 1, 0, 0, 0}, point.p).energy;
    const double expected =
        std::visit([&](const auto& energy) { return energy_of(energy, State(C)); }, card(options, point.p));
    meter.see(std::abs(at.energy - rest - expected) / scale_of(at.stress), [&] {
      return fmt::format("W = {:.10g} kPa, and {:.10g} kPa by the energy of the card,", at.energy - rest, expected) +
             where(model, point);
    });
  }
  return meter.verdict();
}

}  // namespace tunica::conformance
