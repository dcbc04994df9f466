// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tunica::cards {

/// A model with values for its parameters, as a card needs them.
struct Material {
  std::string type = {};                      ///< of the model: "yeoh"
  std::map<std::string, double> values = {};  ///< of its parameters by name, in base units (kPa, deg, 1)
  std::string fibre_switch = "strain";        ///< the option of fibre models
  double bulk = 0;                            ///< fitted bulk modulus, kPa; 0 = the fit is incompressible
  std::string volume_law = "quadratic";       ///< energy of the volume ratio that goes with it
};

/// One term of a foam, 2μ/α² [Σ λ^α − 3 + (J^(−αβ) − 1)/β], β = ν/(1 − 2ν).
struct FoamTerm {
  double mu, alpha, nu;
};

/// One term of Ogden's energy in his convention, μ/α (Σ λ^α − 3).
struct OgdenTerm {
  double mu, alpha;
};

/// One family of fibres, ψ = k1/(2 k2) [exp(k2 E²) − 1] with E = A I1 + B (M·CM) + (1 − 3A − B) C_rr − 1.
struct FibreFamily {
  double angle;  ///< of M from the axial towards the circumferential direction, degrees
  double k1, k2;
  double A = 0, B = 1;
  /// Whether E has the invariants of the Gasser–Ogden–Holzapfel energy only: κ = A, 1 − 3κ = B.
  [[nodiscard]] bool without_normal() const;
};

/// An energy of fibres in a neo-Hookean matrix μ/2 (I1 − 3): hgo, gho, holzapfel_2015, four_fibre.
struct FibreEnergy {
  double mu;
  std::vector<FibreFamily> families;
};

/// The value of a parameter; throws InputError where it is missing or not finite.
double value_of(const Material& material, const std::string& parameter);
std::vector<OgdenTerm> ogden_terms(const Material& material);
/// hyperfoam and blatz_ko.
bool is_foam(const Material& material);
std::vector<FoamTerm> foam_terms(const Material& material);
/// The constants of `mooney_rivlin`: 2, 3 (with c11), 5 (to the second degree) or 9 (to the third).
std::size_t mooney_terms(const Material& material);
bool has_fibres(const Material& material);
FibreEnergy fibre_energy(const Material& material);

/// The shear modulus at rest, kPa; with fibres the stiffness along the stiffest family that goes with it, μ + 4 k1.
/// Throws InputError where it is not positive: no program would find an equilibrium.
double stiffness_at_rest(const Material& material);

}  // namespace tunica::cards
