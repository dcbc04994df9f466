// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// A rigid sphere of radius R that is pressed to the depth δ into an incompressible, isotropic layer of thickness h, or
/// into a half-space. With the shear modulus μ at rest
///
///   F = 16/3 μ √R δ^(3/2) k(δ)                                                 (Hertz, J. reine angew. Math. 92:156,
///   1882)
///
/// and a published k for the layer; χ = √(Rδ)/h:
///
///   bonded  k = 1 + 1.133 χ + 1.283 χ² + 0.769 χ³ + 0.0975 χ⁴   (Dimitriadis, Horkay, Maresca, Kachar, Chadwick,
///   free    k = 1 + 0.884 χ + 0.781 χ² + 0.386 χ³ + 0.0048 χ⁴    Biophys. J. 82:2798, 2002, for ν = 1/2)
///   deep    k = (1 + 1.15 χ + α χ³ + β χ⁶)/(1 + 2.3 χ³)          (Long, Hall, Wu, Hui, Biophys. J. 101:643, 2011:
///                                                                 a neo-Hookean layer that is bonded)
namespace tunica::indentation {

enum class Law { half_space, bonded, sliding, deep };

struct Contact {
  Law law = Law::half_space;
  double radius = 0, thickness = 0;  ///< mm; thickness 0: half-space

  /// F/μ in mm², with δ in mm; and its derivative. 0 before contact.
  [[nodiscard]] double force(double depth) const;
  [[nodiscard]] double slope(double depth) const;
  /// The largest depth that the law was published for.
  [[nodiscard]] double deepest() const;
  /// Why the law does not hold for these sizes; empty where it does.
  [[nodiscard]] std::string objection() const;
};

}  // namespace tunica::indentation
