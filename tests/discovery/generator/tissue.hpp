// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

/// The blind benchmark's own mechanics. It shares no line with tunica, so that a slip in one of them shows as a
/// difference. Units kPa, mm, mN, s; angles in degrees; axes t (circumferential), z (axial), r (radial).
namespace blind {

using Triple = std::array<double, 3>;

/// What the specimen is, before anything is hidden in it.
enum class Base { hgo, gho, holzapfel_2015, four_fibre, yeoh, ogden };

/// What a specimen is made of, and what may be hidden in it, each at its null.
struct Tissue {
  Base base = Base::hgo;
  double mu = 0, k1 = 0, k2 = 0, theta = 0;  ///< θ from the axial direction
  double kappa = 0;                          ///< mean squared sine of the fibres' scatter, over two
  double A = 0, B = 0;                       ///< of holzapfel_2015: mean squares across, and along less across
  double axial_k = 0, axial_k2 = 1;          ///< fibres along z: of four_fibre, or hidden
  double around_k = 0, around_k2 = 1;        ///< fibres along t
  double c10 = 0, c20 = 0, c30 = 0;          ///< of yeoh, kPa
  double mu_1 = 0, alpha_1 = 1;              ///< of ogden, kPa and 1
  double mu_2 = 0, alpha_2 = 1;
  double stiffening = 0, inverse_limit = 0;   ///< of the matrix: exponential; chains with an end
  double second_invariant = 0;                ///< kPa
  double recruitment = 1;                     ///< stretch at which the fibres are taken up
  double tone = 0;                            ///< kPa, along t
  double softening = 0, softening_width = 1;  ///< s, m
  double branch = 0, relaxation = 1;          ///< g, τ in s
  double quadratic_matrix = 0;                ///< outside the catalogue: kPa (I1 − 3)²
  double fibre_power = 0;                     ///< outside: fibre stress ∝ E^(1 + this)
  double axial_stiffening = 0;                ///< outside: kPa (C_zz − 1)², in compression too
};

/// What a point remembers: the largest energy so far, the overstress, and the deviator it was last driven from.
struct Memory {
  double highest = 0;
  Triple over{}, driver{};
};

/// A tissue whose stress is asked for in a frame of principal stretches: C = diag(c), S = diag(S) as far as it matters.
/// In strips the frame is pulled, transverse, normal direction; in tubes t, z, r.
class Material {
 public:
  enum class First { circumferential, axial };
  /// `turn`: angle by which the material axes are off the frame, in the plane of the first two axes.
  Material(const Tissue& tissue, First first, double turn);

  [[nodiscard]] bool remembers() const { return tissue_.softening != 0 || tissue_.branch != 0; }
  [[nodiscard]] Memory at_rest() const;
  /// Second Piola–Kirchhoff stress without the pressure, no history; NaN beyond the end of the chains.
  [[nodiscard]] Triple elastic(const Triple& c) const;
  /// The same with history, a step of `dt` after `old`; `fresh` may be null.
  [[nodiscard]] Triple with_memory(const Triple& c, const Memory& old, double dt, Memory* fresh) const;
  [[nodiscard]] const Tissue& tissue() const { return tissue_; }

 private:
  struct Family {
    Triple h;         ///< diagonal of the structure tensor H = ∫ ρ(n) n⊗n dn
    double k, k2;     ///< kPa, 1
    double strength;  ///< how many families this one stands for
    double power;     ///< ψ' ∝ E^(1 + power)
  };
  [[nodiscard]] double energy(const Triple& c) const;
  [[nodiscard]] double matrix_energy(const Triple& c) const;
  [[nodiscard]] Triple matrix(const Triple& c) const;
  [[nodiscard]] Triple deviator(const Triple& S, const Triple& c) const;

  Tissue tissue_;
  std::vector<Family> families_;
  Triple around_{}, along_{};  ///< structure of the t and z directions
};

/// ∫ ρ n_1² dn of fibres scattered rotationally symmetrically about axis 1, and ∫ ρ n_2² dn: von Mises density whose
/// concentration is such that the second is κ (Gasser, Ogden, Holzapfel 2006, eqs. 2.22 and 2.24), by quadrature.
struct Scatter {
  double along = 1, across = 0, normal = 0;
};
Scatter scatter(double kappa);

/// Mean squares of fibres scattered differently in the wall and out of it, by quadrature over both angles: density
/// exp(a cos 2Φ) in the wall and exp(b cos 2Θ) cos Θ out of it, Θ being the elevation (Holzapfel et al. 2015, section
/// 2).
Scatter scatter_in_and_out(double a, double b);

}  // namespace blind
