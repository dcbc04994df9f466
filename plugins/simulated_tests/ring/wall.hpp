// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "../thick_wall_pressurisation/rule.hpp"
#include "tunica/detail/free_strip.hpp"
#include "tunica/model.hpp"
#include "tunica/strip_path.hpp"

/// A ring between two pins: two straight legs, and half of a circle around each pin.
///
/// Let the unloaded ring have the inner radius Ri, the thickness H, its centreline at Rc = Ri + H/2; the pins have the
/// radius a and are d apart, from centre to centre. The length of the centreline gives its stretch λ, the wall having
/// thinned to H λr (Mahutga, Schoephoerster, Barocas, Exp. Mech. 61:53, 2021, and the program that goes with it):
///
///   2π Rc λ = 2 d + 2π (a + ½ H λr(λ))
///
/// λr is that of a free strip at λ. Each leg bears the nominal stress P of such a strip. A thick wall that is
/// straightened stretches its layers unequally, a layer at R by λ Rc/R (Ericksen, Z. angew. Math. Phys. 5:466, 1954,
/// family 2):
///
///   F = 2 w ∫ P(λ Rc/R) dR,   or with the centreline for all layers  F = 2 w H P(λ)
namespace tunica::ring {

struct Ring {
  double inner_radius, thickness, width, pin_radius;  ///< mm

  [[nodiscard]] double centre() const { return inner_radius + 0.5 * thickness; }
  /// Distance of the pins at which the centreline has its unloaded length.
  [[nodiscard]] double taut() const { return std::numbers::pi * (centre() - pin_radius - 0.5 * thickness); }
};

/// The rows of one prediction.
class Wall {
 public:
  /// `layers`: where the rule has points between inside and outside, as fractions of the thickness; the weights sum
  /// to 1.
  Wall(const Ring& ring, std::span<const double> places, std::span<const double> weights)
      : ring_(ring), places_(places), weights_(weights) {}

  /// Solves every row; `lost` is the row that has no equilibrium.
  Status solve(const Model& model, std::span<const double> parameters, std::span<const double> distance,
               bool derivatives, std::size_t& lost);

  // Of row i: stretch of the centreline and of the wall's thickness there, force in mN, with their derivatives.
  std::vector<double> stretch, thinning, force;                ///< n
  std::vector<double> stretch_by_distance, force_by_distance;  ///< n
  std::vector<double> stretch_dp, force_dp;                    ///< n_p·n, parameter j of row i at [j·n + i]

 private:
  /// Strips at these stretches: Cauchy stress, y = ln λ2² and their derivatives as StripPath has them.
  struct Strips {
    std::vector<double> stress, y, stress_by_l, y_by_l, stress_dp, y_dp;
  };
  Status pull(const Model& model, std::span<const double> parameters, std::span<const double> at, bool by_parameters,
              Strips& strips, std::size_t& lost);
  Status find_centreline(const Model& model, std::span<const double> parameters, std::span<const double> distance,
                         bool derivatives, std::size_t& lost);

  const Ring& ring_;
  std::span<const double> places_, weights_;
  free_strip::Scratch scratch_;
};

}  // namespace tunica::ring
