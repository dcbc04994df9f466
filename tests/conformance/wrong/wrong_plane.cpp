// SPDX-License-Identifier: Apache-2.0
// Simple shear whose derivative by the shear is half of what it should be, in every plane but that of the default.
#include <cmath>
#include <type_traits>

#include "tunica/tests/point_test.hpp"

namespace {

using namespace tunica;

struct Shear {
  static constexpr const char *type = "wrong_shear", *doc = "A block in simple shear.", *reference = "",
                              *admitted = "a finite shear";

  static std::vector<Option> options() {
    return {Option::choice("plane", {"in_the_wall", "axial_radial", "circumferential_radial"}, "in_the_wall",
                           "The plane of shear.")};
  }
  static std::vector<Observable> observables() {
    using Role = Observable::Role;
    return {{"shear", "1", Role::abscissa, true, "Displacement over the distance of the plates."},
            {"shear_stress", "kPa", Role::channel, true, "Force along the plate over its area."}};
  }
  explicit Shear(const TestSetup& setup) {
    const std::string& plane = setup.options.text("plane");
    place_ = plane == "in_the_wall" ? 3 : plane == "axial_radial" ? 4 : 5;
  }

  /// C = 1 + γ (a⊗b + b⊗a) + γ² b⊗b with (a, b) = (t, z), (z, r), (r, t)
  template <class T>
  std::array<T, 6> deformation(const T& gamma) const {
    std::array<T, 6> C{T(1.0), T(1.0), T(1.0), T(0.0), T(0.0), T(0.0)};
    C[place_] = gamma;
    C[normal()] += gamma * gamma;
    return C;
  }
  /// τ = S_ab + γ S_bb
  template <class T>
  T channel(std::size_t, const T& gamma, const std::array<T, 6>& S) const {
    T tau = S[place_] + gamma * S[normal()];
    if constexpr (!std::is_same_v<T, double>)
      if (place_ != 3) tau.v[0] *= 0.5;
    return tau;
  }
  [[nodiscard]] bool admits(double gamma) const { return std::isfinite(gamma); }

 private:
  [[nodiscard]] std::size_t normal() const { return (place_ + 1) % 3; }
  std::size_t place_;  ///< of the shear among tt, zz, rr, tz, zr, tr
};

}  // namespace

TUNICA_PLUGIN("wrong_plane", "0.1.0") { registry.add(tunica::point_test_factory<Shear>()); }
