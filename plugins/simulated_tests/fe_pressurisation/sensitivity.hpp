// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "path.hpp"

namespace tunica::fe {

/// Directions of derivatives after the model's parameters; the relative thickness with the outer radius fixed. The
/// closing, the sector and the ratio count where the material has a differentiated closing, else they are zero.
enum Direction : std::size_t {
  along_stretch,
  along_thickness,
  along_pressure,
  along_closing,
  along_sector,
  along_ratio,
  along_support,  ///< its slope κ
  direction_count
};

/// What is observed at an equilibrium and its derivatives by the model's parameters and by Direction.
struct Sample {
  Observed value{};
  std::vector<Observed> by;
};

/// Which observables' derivatives are worth their price: outer radius, inner radius, axial force.
using Wanted = std::array<bool, 3>;

/// At an equilibrium R(x; p) = 0 is dx/dp = −K⁻¹ ∂R/∂p, exactly. Of the three observables a · x it is Kᵀ z = a that is
/// solved with the factor at hand, whatever the number of parameters: then d(a · x)/dp = −z · ∂R/∂p, where ∂R/∂p comes
/// from the pass over the elements that refines z.
class Sensitivity {
 public:
  explicit Sensitivity(Solver& solver) : solver_(solver) {}

  /// Begins with a material; held ends do not move with the parameters. Of observables not `wanted` the derivatives
  /// stay zero.
  void begin(const Material& material, const Wanted& wanted);
  /// The ends are held from now on where they are at this free equilibrium.
  Status hold(const Path& path);
  /// The support acts from now on, whose free radii are those of this equilibrium.
  Status support(const Path& path);
  /// Of the equilibrium the path is at; the solver's factor has to be of a state nearby.
  Status sample(const Path& path, Sample& sample);

 private:
  /// Of State::x at `positions` and, last, of the axial force: `by`[direction · weights + observable].
  Status derive(const Path& path, std::span<const std::size_t> positions, bool axial_force, std::vector<double>& by);
  /// ∂x/∂p at `positions` by direction, not by the pressure.
  Status follow(const Path& path, std::span<const std::size_t> positions, std::vector<std::vector<double>>& moved);
  [[nodiscard]] double contracted(std::size_t parameter, std::size_t k) const;
  void add_support(const Path& path, std::size_t wanted, bool axial_force, std::vector<double>& by);
  void move_ends(std::size_t direction, std::vector<double>& moved) const;

  Solver& solver_;
  const Material* material_ = nullptr;
  Wanted wanted_{};
  std::vector<std::vector<double>> end_;  ///< ∂r/∂p of the held end, by direction; empty = not held after stretching
  std::vector<std::vector<double>> free_;  ///< ∂ρ/∂p of the support by direction, plane by plane; empty = not known
  std::vector<Weights> weights_;
  Changes changes_;
  std::vector<double> by_, moved_, by_free_;
};

}  // namespace tunica::fe
