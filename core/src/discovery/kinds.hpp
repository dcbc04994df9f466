// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "discovery/reach.hpp"
#include "discovery/request.hpp"
#include "tunica/options.hpp"
#include "tunica/parameter.hpp"

namespace tunica::discovery {

/// A parameter of a term beside its amplitude: where it may lie on these data, and where a search for it begins.
struct Shape {
  std::string name;
  double low, high;
  Scale scale;
  std::vector<double> starts;
};

/// A term that the energy may have: an invariant, a law, and the ranges of its parameters that these data can tell
/// apart.
struct Kind {
  std::string invariant, family, law;  ///< as `composed` names them; the family of fibres only
  std::string name;                    ///< "I2_linear", "fibre_axial_quadratic"
  std::vector<double> knots = {};      ///< of a spline
  bool negative = false;               ///< of stretches: exponents below 0
  double largest = 0;                  ///< amplitude, with its sign where it is negative; 0 = as declared
  std::vector<Shape> shapes = {};
  std::vector<std::string> heights = {};  ///< of a spline: its other amplitudes
  Reach reach = {};                       ///< of the invariant in the data
  double log_prior = 0;                   ///< ln of its share among all kinds

  [[nodiscard]] bool isotropic() const { return !invariant.starts_with("fibre"); }
  [[nodiscard]] bool of_volume() const { return invariant == "J"; }
  [[nodiscard]] bool is_product() const { return invariant.find('*') != std::string::npos; }
  /// Whether it has no parameter but its amplitude and the direction of a family.
  [[nodiscard]] bool is_linear() const {
    return heights.empty() && std::ranges::all_of(shapes, [](const Shape& one) { return one.name == "theta"; });
  }
  /// Whether a free curve may stand in its place.
  [[nodiscard]] bool may_be_a_curve() const { return invariant != "stretches" && !of_volume() && !is_product(); }
  /// Where its curve begins: J may fall.
  [[nodiscard]] double least() const { return of_volume() ? reach.low : 0; }
  /// "I2", "fibre diagonal"
  [[nodiscard]] std::string invariant_words() const { return family.empty() ? invariant : invariant + " " + family; }
  /// Of its amplitude: "mu", "k", "k1", "K", "slope", "c_1".
  [[nodiscard]] std::string amplitude() const;
  /// Options of the mechanism `added_term`.
  [[nodiscard]] Options options() const;
};

/// Sets of terms share their kinds.
using KindPointer = std::shared_ptr<const Kind>;

/// Every kind that the request asks for and the data reach. Without a list, invariants of fibres take part only where
/// the base has directions, those of the volume and of the strain at constant volume where the base changes its volume
/// and the data show it, and products not at all. All have the same prior weight, but for a logarithm of
/// I1 and chains in I2, which nobody uses.
std::vector<Kind> kinds_of(const Request& request, const States& states, bool has_directions, bool sees_volume = false);

/// A free curve in the place of a law, with so many pieces, over the range that the data reach.
Kind curve_of(const Kind& kind, std::size_t pieces);

}  // namespace tunica::discovery
