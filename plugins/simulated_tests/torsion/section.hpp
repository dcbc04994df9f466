// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <ceres/jet.h>

#include "../thick_wall_pressurisation/rule.hpp"
#include "tunica/model.hpp"

/// Inflation, extension and torsion of a tube or a solid cylinder (Rivlin, Phil. Trans. R. Soc. A 242:173, 1949; Green,
/// Adkins, Large Elastic Deformations, 1960, section 2.6).
///
/// A point at R, Θ, Z moves to r, Θ + φ Z, λz Z, with φ the twist over the unloaded length and
///
///   r² = ri² + (R² − Ri²)/λz,   F_tt = r/R,   F_tz = r φ,   F_zz = λz,   F_rr = R/(r λz)
///
/// in the order circumferential, axial, radial; σ = F S Fᵀ − p 1. Equilibrium across the wall, the reduced axial force
/// (beside the pressure on closed ends) and the torque are
///
///   P = ∫ (σtt − σrr)/r dr,   F = π ∫ (2 σzz − σtt − σrr) r dr,   M = 2π ∫ σtz r² dr.
namespace tunica::torsion {

/// The variables of a section and their order: y = ln ri, λz, φ, and Ri.
enum Variable : int { ln_inner, axial, twist, inner, variable_count };
using Jet = ceres::Jet<double, variable_count>;

/// The resultants of a section.
struct Loads {
  Jet pressure, force, torque;
};

/// One section, evaluated with a model at the points of a Gauss rule in R².
class Section {
 public:
  /// `outer`: the unloaded outer radius in mm. A solid cylinder has the inner radius 0 and no y.
  Section(const Model& model, std::span<const double> parameters, double outer, int points);

  /// Loads with their derivatives at `at`, in the order of Variable; φ in 1/mm. False where the energy is undefined.
  bool evaluate(const std::array<double, variable_count>& at, bool by_parameters);
  [[nodiscard]] const Loads& loads() const { return loads_; }
  /// Derivatives by a parameter of the model at the same geometry, as values of the jets.
  [[nodiscard]] Loads by_parameter(std::size_t j) const;

 private:
  /// Integrals over the wall of a stress, or of its derivative by a parameter.
  template <class Stress>
  [[nodiscard]] Loads integrate(const Stress& stress) const;

  const Model& model_;
  std::span<const double> parameters_;
  double outer_;
  thick_wall::Rule rule_;
  std::array<Jet, variable_count> geometry_;
  std::vector<double> C_, S_, A_, S_dp_;
  std::vector<std::array<Jet, 6>> C_jet_;
  std::vector<Jet> r2_, R2_;
  Loads loads_;
};

}  // namespace tunica::torsion
