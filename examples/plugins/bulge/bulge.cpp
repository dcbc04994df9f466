// SPDX-License-Identifier: Apache-2.0
// Inflation of a membrane: a flat circular membrane of radius a and thickness T, clamped at its rim, is blown up to a
// cap of height h by a pressure p. With the usual assumption of a spherical cap that is stretched evenly and equally in
// all directions (Reuge, Schmidt, Le Maoult, Rachik, Abbé 2001, Polym. Eng. Sci. 41:522–531),
//
//   φ = 2 atan(h/a),   λ = φ/sin φ,   radius of the cap a/sin φ,   thickness T/λ²,
//
// and equilibrium of a cap, Laplace's law with both Cauchy stresses, p = (T/λ²) (sin φ/a) (σ_t + σ_z). A free surface
// fixes the pressure that S leaves open: σ_b = λ² S_b − λ⁻⁴ S_r, b = t, z.
#include "tunica/tests/point_test.hpp"

using namespace tunica;

struct BulgeGeometry {
  static constexpr auto type = "bulge", doc = "A circular membrane, clamped at its rim and blown up to a cap.",
                        reference = "Reuge, Schmidt, Le Maoult, Rachik, Abbé, Polym. Eng. Sci. 41:522 (2001)",
                        admitted = "a height above 0; leave the flat membrane out";
  static constexpr std::array diagnostics{Quantity{"pole_stretch", "1"}};
  double radius, thickness;  // mm

  explicit BulgeGeometry(const TestSetup& setup)
      : radius(setup.options.number("radius")), thickness(setup.options.number("thickness")) {}
  static std::vector<Option> options() {
    return {Option::quantity("radius", "mm", 1e-6, "Radius of the membrane inside its clamp."),
            Option::quantity("thickness", "mm", 1e-6, "Thickness of the flat membrane.")};
  }
  static std::vector<Observable> observables() {
    return {{"height", "mm", Observable::Role::abscissa, true, "Height of the pole above the rim."},
            {"pressure", "kPa", Observable::Role::channel, true, "Pressure in the membrane."}};
  }
  bool admits(double height) const { return height > 0; }
  double diagnostic(std::size_t, double height) const { return cap(height).stretch; }

  /// λ and sin φ at height h.
  template <class T>
  struct Cap {
    T stretch, sine;
  };
  template <class T>
  Cap<T> cap(const T& height) const {
    using std::atan, std::sin;
    const T phi = 2.0 * atan(height / radius), sine = sin(phi);
    return {phi / sine, sine};
  }

  /// C = diag(λ², λ², λ⁻⁴)
  template <class T>
  std::array<T, 6> deformation(const T& height) const {
    using std::pow;
    const T stretch = cap(height).stretch;
    return {stretch * stretch, stretch * stretch, pow(stretch, -4.0), T(0), T(0), T(0)};
  }
  /// p = (T/λ²) (sin φ/a) (λ² (S_t + S_z) − 2 λ⁻⁴ S_r)
  template <class T>
  T channel(std::size_t, const T& height, const std::array<T, 6>& S) const {
    using std::pow;
    const auto [l, sine] = cap(height);
    return thickness * sine / (radius * l * l) * (l * l * (S[0] + S[1]) - 2.0 * pow(l, -4.0) * S[2]);
  }
};

TUNICA_PLUGIN("bulge", "1.0.0") { registry.add(point_test_factory<BulgeGeometry>()); }
