// SPDX-License-Identifier: Apache-2.0
// Loads that prescribe a change of volume: for compressible models only.
//
//   confined compression  F = 1 + (λ − 1) a⊗a in a rigid, smooth chamber: C = λ² a⊗a + b⊗b + c⊗c, J = λ,
//                         σ_aa = λ S_aa = P_aa,   σ_bb = S_bb/λ
//   volumetric            F = J^(1/3) 1 in a fluid under pressure: p = −⅓ σ : 1 = −⅓ S : C/J
//
// Confined: Buschmann, Soulhat, Shirazi-Adl, Jurvelin, Hunziker, J. Biomech. 31:171 (1998). Volumetric: Adams, Gibson,
// J. Wash. Acad. Sci. 20:213 (1930). A material with directions changes its shape under pressure; the volumetric test
// holds the shape, and is exact for isotropic materials.
#include <array>
#include <cmath>

#include "tunica/detail/free_faces.hpp"
#include "tunica/tests/point_test.hpp"

namespace {

using namespace tunica;
using Role = Observable::Role;
using Kind = Observable::Kind;

struct ConfinedCompression {
  static constexpr const char* type = "confined_compression";
  static constexpr const char* doc = "A specimen in a rigid, smooth chamber, compressed by a piston; it cannot widen.";
  static constexpr const char* reference =
      "Buschmann, Soulhat, Shirazi-Adl, Jurvelin, Hunziker, J. Biomech. 31:171 (1998)";
  static constexpr const char* admitted = "a stretch above 0";
  static constexpr auto volume = TestDescription::Volume::free;

  static std::vector<Option> options() {
    return {Option::choice("direction", {"circumferential", "axial", "radial"}, "radial",
                           "Material axis that the piston moves along.")};
  }
  static std::vector<Observable> observables() {
    return {{"stretch", "1", Role::abscissa, true, "Height over that before.", Kind::stretch},
            {"stress", "kPa", Role::channel, false, "Stress along the piston; compression is negative.", Kind::stress},
            {"lateral_stress", "kPa", Role::channel, false,
             "Stress on the wall of the chamber, mean of both lateral axes.", Kind::stress}};
  }
  explicit ConfinedCompression(const TestSetup& setup) {
    const std::string& direction = setup.options.text("direction");
    along_ = direction == "circumferential" ? 0 : direction == "axial" ? 1 : 2;
    second_ = setup.stress_measure == "second_piola_kirchhoff";
    first_ = setup.stress_measure == "first_piola_kirchhoff";
  }
  template <class T>
  std::array<T, 6> deformation(const T& x) const {
    std::array<T, 6> C{T(1), T(1), T(1), T(0), T(0), T(0)};
    C[along_] = x * x;
    return C;
  }
  template <class T>
  T channel(std::size_t k, const T& x, const std::array<T, 6>& S) const {
    if (k == 0) return second_ ? S[along_] : x * S[along_];
    const T lateral = 0.5 * (S[(along_ + 1) % 3] + S[(along_ + 2) % 3]);
    return first_ || second_ ? lateral : lateral / x;
  }
  [[nodiscard]] bool admits(double x) const { return std::isfinite(x) && x > 0; }

 private:
  std::size_t along_;
  bool first_, second_;
};

struct Volumetric {
  static constexpr const char* type = "volumetric";
  static constexpr const char* doc =
      "A specimen in a fluid under pressure: its volume changes and its shape stays, as of an isotropic material.";
  static constexpr const char* reference = "Adams, Gibson, J. Wash. Acad. Sci. 20:213 (1930)";
  static constexpr const char* admitted = "a volume ratio above 0";
  static constexpr auto volume = TestDescription::Volume::free;

  static std::vector<Option> options() { return {}; }
  static std::vector<Observable> observables() {
    return {{"volume_ratio", "1", Role::abscissa, true, "Volume over that before.", Kind::plain},
            {"pressure", "kPa", Role::channel, false, "Pressure of the fluid; positive in compression.", Kind::plain}};
  }
  explicit Volumetric(const TestSetup&) {}
  template <class T>
  std::array<T, 6> deformation(const T& x) const {
    using std::pow;
    const T c = pow(x, 2.0 / 3.0);
    return {c, c, c, T(0), T(0), T(0)};
  }
  template <class T>
  T channel(std::size_t, const T& x, const std::array<T, 6>& S) const {
    return -(1.0 / 3.0) * free_faces::contract(deformation(x), S) / x;
  }
  [[nodiscard]] bool admits(double x) const { return std::isfinite(x) && x > 0; }
};

}  // namespace

TUNICA_PLUGIN("volume_change", TUNICA_PLUGIN_VERSION) {
  registry.add(tunica::point_test_factory<ConfinedCompression>());
  registry.add(tunica::point_test_factory<Volumetric>());
}
