// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "element.hpp"
#include "material.hpp"
#include "mesh.hpp"

namespace tunica::fe {

/// Positions r, z of every node (2 · node, 2 · node + 1) in mm, and the pressure modes of every element in kPa.
struct State {
  std::vector<double> x, q;
};

/// Place of (i, j) and of (j, i) in an upper triangle by columns.
constexpr std::size_t upper(std::size_t i, std::size_t j) { return i <= j ? j * (j + 1) / 2 + i : i * (i + 1) / 2 + j; }

/// The elements of a mesh with the same Z, worked through together, one lane an element: what each of them adds to the
/// derivatives of Π (see Assembly). Every array has the lanes last.
///
/// At a Gauss point the energy is a function w(f) = W(C) − q (J − 1) of f = (r_R, r_Z, z_R, z_Z, r/R), which is linear
/// in the positions of the nodes: with p = ∂w/∂f and A = ∂²w/∂f² the force is ∫ pᵀ ∂f/∂x dV and the stiffness
/// ∫ (∂f/∂x)ᵀ A ∂f/∂x dV.
template <std::size_t Order>
class Row {
 public:
  using E = Element<Order>;
  static constexpr std::size_t nn = E::nodes, ng = E::points, np = E::modes, dofs = 2 * nn;

  explicit Row(const Mesh& mesh);

  [[nodiscard]] std::size_t lanes() const { return n_; }
  [[nodiscard]] const E& element() const { return element_; }
  [[nodiscard]] double radius(std::size_t g, std::size_t e) const { return radius_[g * n_ + e]; }
  /// Of the elements of row `row`, along Z.
  [[nodiscard]] double height(std::size_t row) const {
    return mesh_.layer[(row + 1) * Order] - mesh_.layer[row * Order];
  }
  [[nodiscard]] std::size_t node(std::size_t a, std::size_t e, std::size_t row) const {
    return mesh_.node(e * Order + a % E::side, row * Order + a / E::side);
  }
  /// Volume of a Gauss point, dV = R dR dZ.
  [[nodiscard]] double volume(std::size_t g, std::size_t e) const { return area(g) * measure_[g * n_ + e]; }

  /// Takes row `row` of the state: f and C at its points.
  void take(const State& state, std::size_t row);
  /// First derivatives of W there, and the second and those by parameters where wanted.
  Status evaluate(const Material& material, bool tangent, bool parameters);
  /// force and c; with `tangent` also k and coupling, and the largest modulus into `stiffness`.
  void integrate(bool sees_shear, bool tangent, double& stiffness);

  /// What the derivatives of force and c by x and q make of fields y, h of nodes and modes: `forces`[(k · dofs + i) ·
  /// lanes + e] = K y_k − G h_k, `dilations`[(k · modes + m) · lanes + e] = Gᵀ y_k. Needs second derivatives.
  void multiply(bool sees_shear, std::span<const State> fields, std::span<double> forces, std::span<double> dilations);
  /// After multiply() and with derivatives by parameters: d(force)/dp_j at fixed x, `by`[(j · dofs + i) · lanes + e].
  /// The p are the parameters of the material, then the relative thickness at fixed Ro. Where the material has a
  /// differentiated closing the rest of Geometry follows.
  void change(const Material& material, std::span<double> by);
  /// dc/d(relative thickness) at fixed x: `c`[m · lanes + e].
  void dilate(std::span<double> c);

  std::vector<double> f, C, first, second, first_dp;  ///< component-major over points · lanes
  std::vector<double> force, k, coupling, c;          ///< component · lane; coupling: mode · dofs + dof; k as upper
  std::vector<double> scratch;                        ///< 10 lanes, of no meaning between calls

 private:
  /// Weight of a Gauss point over its R in a mean element.
  [[nodiscard]] double area(std::size_t g) const { return element_.weight[g] * h_ * height(row_) / 4; }
  void deform();
  void integrate_lanes(bool sees_shear, bool tangent, double& stiffness);
  void interpolate(std::size_t g, std::span<const double> nodes, std::span<double> f) const;
  auto lanes_at(std::size_t g) const;
  void stress(std::size_t g, bool sees_shear);
  void moduli(std::size_t g, bool sees_shear, double& stiffness);
  void add_shear(std::size_t g);
  void narrow(std::vector<double>& of, bool twice) const;
  void change_lanes(const Material& material, bool closed, double* by);
  template <bool Adds>
  void pull_back(const double* w, bool sees_shear);
  void sum_forces(double* to);
  void thicken(std::size_t g, bool sees_shear);
  void turn(std::size_t g, bool sees_shear);
  void close(const Closing& closing, std::size_t v, bool sees_shear);
  void add_force(std::size_t g, double* force);
  void multiply_lanes(bool sees_shear, std::span<const State> fields, double* forces, double* dilations);
  void take_field(std::span<const double> field);
  void add_stiffness(std::size_t g);
  void add_coupling(std::size_t g, bool tangent);

  const Mesh mesh_;
  const std::size_t n_;  ///< lanes: elements along R
  const double h_;       ///< their mean length
  const E element_;
  std::size_t row_ = 0;
  std::vector<double> radius_, over_radius_;      ///< R and N/R: point · (node ·) lane
  std::vector<double> measure_, narrow_;          ///< R times the length of the lane over the mean; the inverse ratio
  std::vector<double> x_, q_, p_, a_;             ///< component · lane
  std::vector<double> z_, phi_;                   ///< a direction at the nodes, its f: component · point · lane
  std::vector<double> change_, turned_, closed_;  ///< component · point · lane
  std::vector<double> unit_volume_;               ///< of a point over the height of the row
  std::vector<double> moduli_;                    ///< point · as a_
};

extern template class Row<1>;
extern template class Row<2>;

}  // namespace tunica::fe
