// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "../plane_elements/membrane.hpp"

/// A circular membrane of radius a and thickness H, clamped at its rim and inflated by a pressure p.
///
/// A material point at radius R moves to the radius r = R f(s) and the height z = a g(s), with s = (R/a)². So both are
/// smooth at the pole, and the squared stretches along the meridian and the parallel are
///
///   C1 = (f + 2 s f')² + 4 s g'²,   C2 = f²   (Adkins, Rivlin, Phil. Trans. R. Soc. A 244:505, 1952, section 10)
///
/// Equilibrium makes this stationary, W being the energy of the membrane and V the volume below it (Green, Adkins,
/// Large Elastic Deformations, 1960, chapter IV):
///
///   (H ∫ W − p V)/(π a² H) = ∫₀¹ W(C1, C2) ds + q ∫₀¹ s f² g' ds,   q = p a/H
///
/// with f(1) = the stretch at which it was clamped, g(1) = 0 and g(0) = the height of the apex, which is prescribed. So
/// q is an unknown, and a largest pressure is no obstacle.
namespace tunica::bulge {

/// Elements of degree 4 in s between equal steps of the radius: 4 elements + 1 nodes. The pole stretches most.
struct Mesh {
  static constexpr std::size_t degree = 4;
  struct Point {
    double s, weight;
    std::size_t first;                            ///< node
    std::array<double, degree + 1> shape, slope;  ///< of the nodes from `first` on; slope by s
  };
  std::size_t nodes;
  std::vector<Point> points;               ///< of Gauss
  std::array<double, degree + 1> at_pole;  ///< slopes at s = 0

  explicit Mesh(std::size_t elements);
};

/// The equilibrium at one height after another.
class Inflation {
 public:
  /// `rim`: the stretch of the clamped rim.
  Inflation(const Mesh& mesh, const Model& model, std::span<const double> parameters, plane::Faces faces, double rim);

  /// Finds the equilibrium with the apex at `height`/a > 0, from the one before. Says what went wrong, if anything.
  std::optional<std::string> raise_to(double height);
  /// Prepares the derivatives below. False where the equilibrium is not isolated.
  bool linearise(bool by_parameters);

  /// The observed quantities: q = p a/H, f(0) and g'(0); or their derivatives.
  struct Reading {
    double load, apex, bend;
  };
  [[nodiscard]] Reading reading() const { return reading_of(f_, g_, load_); }
  [[nodiscard]] Reading by_height() const {
    Reading change = solve(-stiffness_.col(height_place()));
    change.bend += mesh_.at_pole[0];  // the apex itself
    return change;
  }
  [[nodiscard]] Reading by_rim() const { return solve(-stiffness_.col(rim_place())); }
  [[nodiscard]] Reading by_parameter(std::size_t j) const { return solve(-by_parameters_.col(static_cast<long>(j))); }
  /// Stretch along the meridian at the Gauss point next to the rim.
  [[nodiscard]] double rim_stretch() const;
  /// Stretch through the thickness where the membrane is stretched alike in all directions, as at the pole. Not a
  /// number where it has no answer.
  [[nodiscard]] double thickness_stretch(double stretch) const;

 private:
  using Vector = Eigen::VectorXd;

  [[nodiscard]] long rim_place() const { return static_cast<long>(mesh_.nodes) - 1; }
  [[nodiscard]] long height_place() const { return static_cast<long>(mesh_.nodes); }
  void begin(double height);
  bool assemble(bool by_parameters);
  bool settle();
  void factorise();
  /// Unknowns are f but at the rim, g but at rim and pole, and q; equations are those of f and g but at the rim.
  [[nodiscard]] Vector reduced(const Vector& all) const;
  [[nodiscard]] Reading solve(const Vector& right) const;
  [[nodiscard]] Reading reading_of(const Vector& f, const Vector& g, double load) const;
  void move(const Vector& step, double share);

  const Mesh& mesh_;
  plane::Membrane membrane_;
  mutable plane::Membrane pole_;
  std::size_t parameter_count_;
  double rim_, height_ = 0, load_ = 0;
  Vector f_, g_, residual_, by_load_;
  Eigen::MatrixXd stiffness_, by_parameters_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
};

}  // namespace tunica::bulge
