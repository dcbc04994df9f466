// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tunica/models/hyperelastic.hpp"
#include "tunica/models/isotropic.hpp"
#include "tunica/models/law_part.hpp"
#include "tunica/models/laws.hpp"
#include "tunica/plugin.hpp"

namespace tunica {
inline constexpr double degree = std::numbers::pi / 180;  ///< in radians: parameters are declared in degrees
}

/// What the models of the arterial wall have in common: a neo-Hookean matrix, a mirrored pair of fibre families at
/// ±theta from the axial direction with an exponential response, and the option that says when fibres carry load.
namespace tunica::arterial {

/// Shear modulus of the matrix, kPa. These four are shared so that models agree on names, bounds and sources.
inline Parameter mu() {
  return {"mu", "kPa", 10, 0.1, 200, Scale::log, "Shear modulus of the matrix.", "Holzapfel, Gasser, Ogden 2000"};
}
/// Stiffness of the fibres, kPa.
inline Parameter k1() {
  return {"k1", "kPa", 10, 0.01, 1000, Scale::log, "Stiffness of the fibres.", "Holzapfel, Gasser, Ogden 2000"};
}
/// How fast the fibres stiffen, dimensionless.
inline Parameter k2() {
  return {"k2", "1", 1, 0.001, 100, Scale::log, "How fast the fibres stiffen.", "Holzapfel, Gasser, Ogden 2000"};
}
/// Angle of the families from the axial direction, in degrees as in files; Geometry turns it into radians.
inline Parameter theta() {
  return {"theta",
          "deg",
          45,
          0,
          90,
          Scale::linear,
          "Angle of the fibres from the axial direction.",
          "Holzapfel, Gasser, Ogden 2000"};
}

/// When a fibre family carries load. `strain`: while E > 0. `stretch`: while its own stretch exceeds 1 (with
/// dispersion W is then discontinuous). `none`: always.
inline Option fibre_switch() {
  return {.name = "fibre_switch",
          .kind = Option::Kind::choice,
          .fallback = std::string("strain"),
          .doc = "When fibres carry load: while E > 0 (strain), while I4 > 1 (stretch), or always (none).",
          .choices = {"strain", "stretch", "none"}};
}

/// What the option fibre_switch() means for a part.
inline EnergyPart::Active active(const Options& options) {
  const std::string& value = options.text("fibre_switch");
  return value == "strain"    ? EnergyPart::Active::argument_positive
         : value == "stretch" ? EnergyPart::Active::fibre_stretched
                              : EnergyPart::Active::always;
}

/// ψ = k1/(2 k2) [exp(k2 E²) − 1] for the families at ±theta, E as Geometry says.
template <class Geometry, std::size_t model_parameters>
std::unique_ptr<EnergyPart> fibres(std::vector<std::size_t> invariant_parameters,
                                   std::vector<std::size_t> response_parameters, const Options& options) {
  return std::make_unique<LawPart<laws::Exponential, Geometry, model_parameters>>(
      EnergyPart::Description{"fibres", EnergyPart::Role::fibre, active(options), true, std::move(invariant_parameters),
                              std::move(response_parameters), false});
}

/// E = I_i − 1 of a single family at a fixed angle from the axial direction.
template <int degrees>
struct FixedFibres {
  /// M·CM − 1 at the fixed angle, of no parameter.
  template <class T>
  static InvariantOf<T> invariant(std::span<const T>) {
    InvariantOf<T> e;
    e.fibre = T(1);
    e.offset = T(-1);
    e.angle = T(degrees * degree);
    return e;
  }
};

/// The same response for one family along an axis, which is its own mirror image and counts once.
template <int degrees, std::size_t model_parameters>
std::unique_ptr<EnergyPart> single_fibres(std::string name, std::vector<std::size_t> response_parameters,
                                          const Options& options) {
  return std::make_unique<LawPart<laws::Exponential, FixedFibres<degrees>, model_parameters>>(EnergyPart::Description{
      std::move(name), EnergyPart::Role::fibre, active(options), false, {}, std::move(response_parameters), false});
}

}  // namespace tunica::arterial
