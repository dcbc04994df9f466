// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "row.hpp"
#include "stencil.hpp"
#include "support.hpp"

namespace tunica::fe {

/// The system of one Newton step at a state, before anything is prescribed, all divided by 2π.
struct System {
  std::vector<double> force;     ///< ∂Π/∂x; zero at the free nodes in equilibrium
  std::vector<double> right;     ///< −force − γ G M⁻¹ c, condensed
  std::vector<double> volume;    ///< ∂V/∂x, V the lumen
  std::vector<double> coupling;  ///< G: element · modes · 2 nodes
  std::vector<double> dilation;  ///< c = ∫ (J − 1) ψ dV, element · modes
  Stencil matrix;                ///< ∂²Π/∂x² + γ G M⁻¹ Gᵀ
  double gamma = 0;              ///< kPa
  double largest_dilation = 0;   ///< max |c| over the element's volume
  double stiffness = 0;          ///< the largest diagonal entry of ∂²w/∂F², kPa
};

/// How an observable depends on the equations of a solution: it changes by right · (what −∂Π/∂x does at a fixed state),
/// by dilation · (what c does there) and by moved · (what the positions of the nodes at the end do).
struct Weights {
  std::vector<double> right, dilation, moved;
};

/// How the equations change with parameters at a fixed state. They are those of the material, then the relative
/// thickness (x and Ro fixed), and with a differentiated closing the rest of Geometry. c depends on the thickness
/// alone.
struct Changes {
  std::vector<double> force;     ///< of ∂Π/∂x, parameter · positions + position
  std::vector<double> dilation;  ///< of c, by the thickness
};

/// A Gauss point of a solution.
struct Point {
  double R = 0, Z = 0;             ///< mm
  std::array<double, 5> f{};       ///< r_R, r_Z, z_R, z_Z, r/R
  std::array<double, 4> energy{};  ///< first derivatives of W, as Material gives them
  double q = 0;                    ///< kPa
  double closing = 1;              ///< λ₀, the circumferential stretch that closed the stress-free sector
  std::size_t column = 0;          ///< of elements

  /// Cauchy stress rr, zz, tt, rz: 2 F (∂W/∂C) Fᵀ − q.
  [[nodiscard]] std::array<double, 4> stress() const;
};

/// The discrete potential of a tube, half its length by symmetry,
///
///   Π(x, q) = ∫ [W(C) − q (J − 1)] dV − P V(x),   dV = R dR dZ  (times 2π),
///
/// total Lagrangian, x the positions in the loaded state and q a hydrostatic pressure without any bulk modulus: J = 1
/// holds exactly in the mean of every pressure mode. V = ∫ ½ r² dz is the lumen over 2π; since the ends keep their z,
/// −P V is the potential of the following pressure, and the tangent is symmetric. Newton's method solves
///
///   | K   −G   | |dx|   |−∂Π/∂x|
///   | −Gᵀ −M/γ | |dq| = |  c   |     so that  dq = −γ M⁻¹ (c + Gᵀ dx),  (K + γ G M⁻¹ Gᵀ) dx = −∂Π/∂x − γ G M⁻¹ c.
///
/// M/γ stands in the matrix alone: the state it converges to is incompressible for any γ.
class Assembly {
 public:
  virtual ~Assembly() = default;
  /// Fills `system`. Without `tangent` matrix and coupling stay those of the last tangent, with which `right` is
  /// condensed: G of another state times γ would swamp it. `gamma` has to stay, too. Fails where a point cannot be
  /// evaluated.
  virtual Status assemble(const Material& material, const State& state, double pressure, bool tangent,
                          System& system) = 0;
  /// ∂V/∂x at a state.
  virtual void by_volume(const State& state, std::span<double> volume) const = 0;
  /// What the derivatives of the equations at a state make of `fields` y, h: `product`.x = K y − G h and .q = Gᵀ y; and
  /// the equations, `residual`.x = ∂Π/∂x and .q = c. No γ is in it, so that it is exact to rounding. `changes` are of
  /// the equations by parameters; none where it is null.
  virtual Status multiply(const Material& material, const State& state, double pressure, std::span<const State> fields,
                          std::span<State> product, State& residual, Changes* changes) = 0;
  /// −weight.right · ∂force/∂κ of the support, and by the free radius of each plane (0 where κ is).
  virtual double contract(const State& state, const Weights& weight, std::span<double> by_free) = 0;
  /// Advances the history of the points to the state, in History::after.
  virtual Status remember(const Material& material, const State& state) = 0;
  /// dq = −γ M⁻¹ (c + Gᵀ dx) for a solved dx; without `dilation` c is zero, and without `dx` that.
  virtual void pressures(const System& system, std::span<const double> dx, std::span<const double> dilation,
                         std::span<double> dq) const = 0;
  /// G dq.
  virtual void spread(const System& system, std::span<const double> dq, std::span<double> force) const = 0;
  /// Volume of the lumen (mm³) and energy of the wall (kPa mm³ = µJ) of half the tube.
  virtual Status energies(const Material& material, const State& state, double& lumen, double& stored) = 0;
  [[nodiscard]] virtual std::size_t pressure_count() const = 0;
  /// Every Gauss point, row of elements by row, element by element.
  virtual Status points(const Material& material, const State& state, std::vector<Point>& found) = 0;

  static std::unique_ptr<Assembly> make(const Mesh& mesh);

  Support support;             ///< acts where its slope is not 0
  std::function<bool()> late;  ///< asked now and then, where it is set: work fails where it says yes
};

}  // namespace tunica::fe
