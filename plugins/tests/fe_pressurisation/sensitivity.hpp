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

/// At an equilibrium R(x; p) = 0 is dx/dp = −K⁻¹ ∂R/∂p, exactly. Of the three observables a · x it is Kᵀ z = a that is
/// solved with the factor at hand, whatever the number of parameters: then d(a · x)/dp = −z · ∂R/∂p. By the thickness
/// only ∂R/∂p is a central difference, of residuals at fixed positions: 1e-9 of it.
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
  /// right_, dilation_ and moved_ of a direction; empty = nothing.
  Status equations(const Path& path, std::size_t direction);
  void move_ends(std::size_t direction, std::vector<double>& moved) const;

  Solver& solver_;
  const Material* material_ = nullptr;
  std::unique_ptr<Assembly> thinner_, thicker_;
  std::vector<double> forces_, right_, dilation_, moved_;
  std::vector<std::vector<double>> end_;  ///< ∂r/∂p of the held end, by direction; empty = not held after stretching
  State derivative_;
  std::array<Solver::Weights, 3> weights_;
  System probe_;
};

}  // namespace tunica::fe
