// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "path.hpp"

namespace tunica::fe {

/// What is observed at an equilibrium and its derivatives by the model's parameters, the axial stretch, the relative
/// wall thickness (outer radius fixed) and the pressure, in this order.
struct Sample {
  Observed value{};
  std::vector<Observed> by;
};

/// Direct differentiation: at an equilibrium R(x; p) = 0 is K dx/dp = −∂R/∂p, one solution with the factor at hand a
/// parameter. By the thickness only ∂R/∂p is a central difference, of residuals at fixed positions: 1e-9 of it.
class Sensitivity {
 public:
  /// `radius` and `thickness` describe the mesh of the solver.
  explicit Sensitivity(Solver& solver);

  /// Begins with a material; held ends do not move with the parameters.
  void begin(const Material& material);
  /// The ends are held from now on where they are at this free equilibrium.
  Status hold(const Path& path);
  /// Of the equilibrium the path is at; the solver's factor has to be exact.
  Status sample(const Path& path, Sample& sample);

 private:
  enum Direction : std::size_t { stretch, thickness, pressure, own };  ///< after the model's parameters
  Status solve(const Path& path, std::size_t direction, State& derivative, std::span<const double>& right);
  void move_ends(std::size_t direction, std::vector<double>& moved) const;

  Solver& solver_;
  const Material* material_ = nullptr;
  std::unique_ptr<Assembly> thinner_, thicker_;
  std::vector<double> forces_, right_, moved_;
  std::vector<std::vector<double>> end_;  ///< ∂r/∂p of the held end, by direction; empty = not held after stretching
  State derivative_;
  System probe_;
};

}  // namespace tunica::fe
