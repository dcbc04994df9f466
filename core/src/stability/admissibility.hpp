// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "stability/drucker.hpp"
#include "stability/ellipticity.hpp"
#include "stability/free_stability.hpp"
#include "stability/transverse.hpp"

namespace tunica::stability {

/// Over which stretches a parameter set is judged.
struct Domain {
  std::array<std::vector<double>, 2> strips;      ///< measured stretches of strips along the circumference and the axis
  std::array<std::vector<double>, 2> asked = {};  ///< stated by a person: in a constraint, on the command line
  double largest = 1.5;                           ///< of any test, for ellipticity and Drucker
  double beyond = 10;                             ///< transverse stability is followed so far

  /// The least stretch that was measured or asked for; where no strip was pressed, 1/largest.
  [[nodiscard]] double least() const;
};

/// Whether a parameter set behaves as a material: what every report says of its best point.
struct Admissibility {
  std::vector<TransverseVerdict> transverse;  ///< circumferential, axial
  EllipticityVerdict ellipticity;
  std::optional<DruckerVerdict> drucker;  ///< isotropic models
  Domain domain;
  /// Of a material that changes its volume, which has no transverse verdict.
  std::optional<FreeFaceVerdict> free_faces = {};

  [[nodiscard]] bool changes_volume() const { return free_faces.has_value(); }
  /// λ3 falls at every stretch that was measured or asked for; none where there is none, or no answer at one of them.
  [[nodiscard]] std::optional<bool> transversely_stable() const;
  /// One sentence a finding, what is lost first.
  [[nodiscard]] std::vector<std::string> sentences() const;
};

Admissibility judge_admissibility(const Model& model, std::span<const double> parameters, const Domain& domain);

}  // namespace tunica::stability
