// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tunica/card_energy.hpp"
#include "tunica/models/hyperelastic.hpp"
#include "tunica/models/isotropic.hpp"
#include "tunica/models/law_part.hpp"
#include "tunica/models/laws.hpp"

namespace tunica {
/// One degree in radians. Angles are declared in degrees; an Invariant takes radians.
inline constexpr double degree = std::numbers::pi / 180;
}  // namespace tunica

/// What models of the arterial wall share: a mirrored pair of fibre families at ±theta from the axial direction with an
/// exponential response, and the option that decides when fibres carry load. The matrix is isotropic::neo_hookean().
namespace tunica::arterial {

/// Source of the four parameters below. They are shared, so that models agree on names, bounds and meaning.
inline constexpr const char* source = "Holzapfel, Gasser, Ogden 2000";

/// Shear modulus of the matrix, kPa.
inline Parameter mu() { return {"mu", "kPa", 10, 0.1, 200, Scale::log, "Shear modulus of the matrix.", source}; }
/// Stiffness of a fibre family, kPa. `family` names it in the documentation: "axial" gives "Stiffness of the axial
/// fibres."
inline Parameter k1(const std::string& family = {}) {
  const std::string fibres = family.empty() ? "fibres" : family + " fibres";
  return {"k1", "kPa", 10, 0.01, 1000, Scale::log, "Stiffness of the " + fibres + ".", source};
}
/// Rate at which a fibre family stiffens, dimensionless. `family` as for k1().
inline Parameter k2(const std::string& family = {}) {
  const std::string fibres = family.empty() ? "fibres" : family + " fibres";
  return {"k2", "1", 1, 0.001, 100, Scale::log, "How fast the " + fibres + " stiffen.", source};
}
/// Angle of the families from the axial direction, in degrees.
inline Parameter theta() {
  const std::string doc = "Angle of the fibres from the axial direction.";
  return {"theta", "deg", 45, 0, 90, Scale::linear, doc, source};
}

/// The option that decides when a fibre family carries load.
///
/// `strain`: while E > 0. `stretch`: while its own stretch exceeds 1; with dispersion W is then discontinuous. `none`:
/// always.
inline Option fibre_switch() {
  return Option::choice("fibre_switch", {"strain", "stretch", "none"}, "strain",
                        "When fibres carry load: while E > 0 (strain), while I4 > 1 (stretch), or always (none).");
}

/// Translates the option fibre_switch() for a part.
inline EnergyPart::Active active(const Options& options) {
  const std::string& value = options.text("fibre_switch");
  return value == "strain"    ? EnergyPart::Active::argument_positive
         : value == "stretch" ? EnergyPart::Active::fibre_stretched
                              : EnergyPart::Active::always;
}

/// A card's energy: a neo-Hookean matrix and the pair at ±theta with E = A I1 + B M·CM + (1 − 3A − B) C_rr − 1.
inline FibreEnergy card_of_pair(double mu, const FibreFamily& family, const Options& options) {
  FibreFamily mirrored = family;
  mirrored.angle = -family.angle;
  return {mu, {family, mirrored}, active(options)};
}

/// E = I_i − 1 of a family at the angle of the model parameter with index `angle`, in degrees.
template <std::size_t angle>
struct AlignedFibres {
  /// M·CM − 1 at that angle.
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    return {.fibre = T(1), .offset = T(-1), .angle = p[angle] * degree};
  }
};

/// E = I_i − 1 of a family at a fixed angle from the axial direction.
template <int degrees>
struct FixedFibres {
  /// M·CM − 1 at the fixed angle, whatever the parameters.
  template <class T>
  static InvariantOf<T> invariant(std::span<const T>) {
    return {.fibre = T(1), .offset = T(-1), .angle = T(degrees * degree)};
  }
};

/// ψ = k1/(2 k2) [exp(k2 E²) − 1] for both families at ±theta, with E of Geometry.
///
/// `invariant_parameters` are the indices of the parameters that E depends on, `response_parameters` those of k1 and
/// k2.
template <class Geometry, std::size_t model_parameters>
std::unique_ptr<EnergyPart> fibres(std::vector<std::size_t> invariant_parameters,
                                   std::vector<std::size_t> response_parameters, const Options& options) {
  return std::make_unique<LawPart<laws::Exponential, Geometry, model_parameters>>(
      EnergyPart::Description{"fibres", EnergyPart::Role::fibre, active(options), true, std::move(invariant_parameters),
                              std::move(response_parameters), false});
}

/// The same response for one family along an axis. It is its own mirror image and counts once.
template <int degrees, std::size_t model_parameters>
std::unique_ptr<EnergyPart> single_fibres(std::string name, std::vector<std::size_t> response_parameters,
                                          const Options& options) {
  return std::make_unique<LawPart<laws::Exponential, FixedFibres<degrees>, model_parameters>>(EnergyPart::Description{
      std::move(name), EnergyPart::Role::fibre, active(options), false, {}, std::move(response_parameters), false});
}

}  // namespace tunica::arterial
