// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tunica/model.hpp"

namespace tunica::plane {

/// What decides on the stretch through the thickness, u = C_rr.
enum class Faces {
  incompressible,  ///< free of traction, and u keeps the volume
  free,            ///< free of traction, and u follows from it
  held             ///< plane strain: u = 1, of a compressible material
};

/// A sheet: the response of a batch of points in the plane of the specimen, whose axes x and y are
/// turned in the plane of the material axes t and z.
///
/// With C̄ the tensor in the plane, u = C_rr and A = 2 ∂S/∂C of the model:
///
///   incompressible  u = 1/det C̄,   S̄ = S − u S_rr G,   G = C̄⁻¹
///                   2 ∂S̄/∂C̄ = A − u (A_rr⊗G + G⊗A_rr) + u² A_rrrr G⊗G + 2 u S_rr (G⊗G + G⊙G)
///   free            S_rr(u) = 0,   2 ∂S̄/∂C̄ = A − A_rr⊗A_rr/A_rrrr
///   held            u = 1,   S̄ = S,   2 ∂S̄/∂C̄ = A
///
/// (physics: docs/theory.md, plane specimens). Components are xx, yy, xy; an off-diagonal entry is the tensor's.
class Membrane {
 public:
  /// `along` is the unit vector of x in the axes t and z.
  Membrane(const Model& model, std::span<const double> parameters, std::array<double, 2> along, Faces faces);

  /// C̄ of n points, 3n entries, component-major.
  std::vector<double> C;
  std::vector<double> stress;     ///< 3n
  std::vector<double> tangent;    ///< 9n: (a, b) of point i at [(3a + b)n + i]
  std::vector<double> stress_dp;  ///< n_p·3n
  std::vector<double> normal;     ///< u of every point; of free faces the start of the next evaluation

  void resize(std::size_t n);
  /// False where a point has no answer.
  bool evaluate(bool with_tangent, bool with_parameters);

 private:
  using Plane = std::array<double, 3>;
  bool respond(bool with_tangent, bool with_parameters);
  bool free_the_faces();

  const Model& model_;
  std::span<const double> parameters_;
  Faces faces_;
  std::array<Plane, 3> dyad_;  ///< of x⊗x, y⊗y and x⊗y made symmetric: components tt, zz, tz
  std::size_t n_ = 0;
  std::vector<double> C6_, S6_, A6_, S6_dp_;
};

}  // namespace tunica::plane
