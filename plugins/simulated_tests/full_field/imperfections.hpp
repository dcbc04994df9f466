// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "edges.hpp"
#include "specimen.hpp"
#include "tunica/parameter.hpp"

namespace tunica::field {

/// Imperfections of a sheet or its mounting that the file does not state.
enum class Flaw {
  clamp_slip,          ///< share of the way of the moved side by which the opposite clamp lets go
  grip_tilt,           ///< how much farther one end of a grip goes than its middle, over its way
  oblique_pull,        ///< angle of the way of a grip to the normal of its side, deg; above 0 where ux uy > 0
  thickness_gradient,  ///< g in h = 1 + g ξ
  thickness_gradient_direction,
  stiffer_half,  ///< c in h = 1 + c tanh(ξ/0.04)
  stiffer_half_direction
};

/// A parameter of the test, at rest at 0.
struct FlawParameter {
  Flaw flaw;
  Parameter parameter;
};

/// All of them, or those that can show between such edges: none where a side is free to be fitted to the points.
std::vector<FlawParameter> all_flaws();
std::vector<FlawParameter> flaws_between(const Edges& edges);

/// One sheet with its flaws, which act on weights of Gauss points and on what edges do. With the way L of the moved
/// side, its mean displacement along the normal less that of a moved opposite side, edges move by
///
///     b_k (mode_k + Σ_q p_q L(mode_k) pattern_q),   L(pattern_q) = 0
///
/// and weights are h of Flaw with ξ = ((x − x_m) cos φ + (y − y_m) sin φ)/√((l_x cos φ)² + (l_y sin φ)²) from the
/// middle of the box, l_x by l_y. At the nulls nothing is touched.
class FlawedSheet {
 public:
  /// `values` by flaw. Keeps the specimen by reference.
  FlawedSheet(const Specimen& specimen, const Edges& edges, const std::vector<Mode>& modes,
              const std::vector<FlawParameter>& flaws, std::span<const double> values);

  [[nodiscard]] const std::vector<double>& weights() const { return weights_; }  ///< empty = 1
  [[nodiscard]] const std::vector<Mode>& modes() const { return modes_; }
  /// Displacements by dof, their edges a sum of the modes without flaws: makes them the same sum with flaws.
  void move_edges(std::vector<double>& u) const;

  /// The derivatives by flaw q: of the weights, empty where they stay, and of the edges at u.
  [[nodiscard]] std::vector<double> weights_by(std::size_t q) const;
  [[nodiscard]] Mode edges_by(std::size_t q, const std::vector<double>& u) const;

 private:
  struct Pattern {
    std::size_t flaw;
    Mode way;    ///< L by dof
    Mode moves;  ///< by dof
  };
  [[nodiscard]] double value(Flaw flaw) const;
  [[nodiscard]] double share(const Pattern& pattern) const;
  void find_patterns(const Edges& edges);

  const Specimen& specimen_;
  const std::vector<FlawParameter>& flaws_;
  std::vector<double> values_;
  std::vector<Pattern> patterns_;
  std::vector<double> weights_;
  std::vector<Mode> modes_;
};

}  // namespace tunica::field
