// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "assembly/assembly.hpp"
#include "uncertainty/identifiability.hpp"

namespace tunica::uncertainty {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double moved = 1e-2;  ///< a direction moves a parameter by more than this share of the box per unit length
constexpr double widest = 0.5;  ///< half width of an interval, in boxes, that says nothing any more

/// How well the data see a direction.
enum class Visibility { not_at_all, weakly, well };

/// The linearised problem in the unit box: directions, singular values, and the variance along each; 1 stands for the
/// whole box where the data see nothing. Rows of V of parameters at bounds are zero.
struct Spectrum {
  Matrix V;
  Vector values, variance;
  std::vector<Visibility> seen;
  double quantile = 0;  ///< of standardised errors, 97.5 %

  [[nodiscard]] double half_width(const Vector& direction) const;
  /// Σ v vᵀ over the directions seen so.
  [[nodiscard]] Matrix projector(Visibility how) const;
};

/// Finds the valleys along directions that are seen not at all, or weakly, and puts them into words.
void add_valleys(const assembly::Assembly& assembly, std::span<const double> free, const Spectrum& spectrum,
                 Visibility how, Identifiability& found);

}  // namespace tunica::uncertainty
