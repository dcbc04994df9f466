// SPDX-License-Identifier: Apache-2.0
// Simple shear between two plates, F = 1 + γ a⊗b: the plate with normal b moves along a, and its area stays. Faces with
// the third direction c as normal are free, which fixes the pressure. With S = 2 ∂W/∂C and C = FᵀF
//
//   σ = F S Fᵀ − p 1:   τ = a·σ b = S_ab + γ S_bb,   σ_n = b·σ b = S_bb − S_cc
//
// (Dokos, Smaill, Young, LeGrice 2002; Holzapfel, Ogden 2009, §5). Force over the plate's area is τ in every measure.
#include <array>
#include <cmath>

#include "tunica/models/arterial_fibres.hpp"
#include "tunica/tests/point_test.hpp"

namespace {

using namespace tunica;

struct SimpleShear {
  static constexpr const char* type = "simple_shear";
  static constexpr const char* doc = "A block between two plates, one of which slides: simple shear in any plane.";
  static constexpr const char* reference =
      "Dokos, Smaill, Young, LeGrice, Am. J. Physiol. Heart Circ. Physiol. 283:H2650 (2002)";
  static constexpr const char* admitted = "a finite shear";

  static std::vector<Option> options() {
    const std::vector<std::string> axes{"circumferential", "axial", "radial"};
    return {Option::choice("direction", axes, "circumferential", "Where the plate moves to."),
            Option::choice("normal", axes, "axial", "The normal of the plates."),
            Option::quantity("angle", "deg", -360,
                             "Turn of the specimen's circumferential and axial axes from those of the material, from "
                             "axial towards circumferential.",
                             0.0)};
  }
  static std::vector<Observable> observables() {
    using Role = Observable::Role;
    return {
        {"shear", "1", Role::abscissa, true, "Displacement of the plate over the distance of the plates."},
        {"time", "s", Role::time, false, "Time since the unloaded state."},
        {"shear_stress", "kPa", Role::channel, false, "Force along the plate over its area."},
        {"normal_stress", "kPa", Role::channel, false, "Force across the plate over its area; tension is positive."}};
  }

  explicit SimpleShear(const TestSetup& setup) {
    const std::string &direction = setup.options.text("direction"), &normal = setup.options.text("normal");
    if (direction == normal)
      throw InputError("simple_shear: \"direction\" and \"normal\" are both '" + normal +
                       "', and a plate slides across its normal; give two different ones");
    const double angle = setup.options.number("angle") * degree;
    // z turns towards t, and t away from z.
    const std::array<Vector, 3> axes{
        {{std::cos(angle), -std::sin(angle), 0}, {std::sin(angle), std::cos(angle), 0}, {0, 0, 1}}};
    const auto index = [](const std::string& name) { return name == "circumferential" ? 0 : name == "axial" ? 1 : 2; };
    a_ = axes[index(direction)];
    b_ = axes[index(normal)];
    c_ = axes[3 - index(direction) - index(normal)];
  }

  /// C = 1 + γ (a⊗b + b⊗a) + γ² b⊗b
  template <class T>
  std::array<T, 6> deformation(const T& gamma) const {
    std::array<T, 6> C;
    for (std::size_t k = 0; k < 6; ++k) {
      const auto [i, j] = pair[k];
      C[k] = (i == j ? 1.0 : 0.0) + gamma * (a_[i] * b_[j] + b_[i] * a_[j]) + gamma * gamma * (b_[i] * b_[j]);
    }
    return C;
  }
  template <class T>
  T channel(std::size_t k, const T& gamma, const std::array<T, 6>& S) const {
    if (k == 0) return product(a_, S, b_) + gamma * product(b_, S, b_);
    return product(b_, S, b_) - product(c_, S, c_);
  }
  /// The plates hold the area; a compressible block changes its thickness along c.
  [[nodiscard]] std::array<double, 3> free_face() const { return c_; }
  [[nodiscard]] bool admits(double gamma) const { return std::isfinite(gamma); }

 private:
  using Vector = std::array<double, 3>;
  static constexpr std::array<std::array<std::size_t, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

  template <class T>
  static T product(const Vector& u, const std::array<T, 6>& S, const Vector& v) {
    T sum(0.0);
    for (std::size_t k = 0; k < 6; ++k) {
      const auto [i, j] = pair[k];
      sum += S[k] * (i == j ? u[i] * v[i] : u[i] * v[j] + u[j] * v[i]);
    }
    return sum;
  }

  Vector a_, b_, c_;
};

}  // namespace

TUNICA_PLUGIN("simple_shear", TUNICA_PLUGIN_VERSION) {
  auto factory = tunica::point_test_factory<SimpleShear>();
  factory.specimen = tunica::Specimen::block;
  registry.add(std::move(factory));
}
