// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "diagnosis/evidence/curves.hpp"

namespace tunica::diagnosis {

/// Smooth shapes that whatever is no noise may have, curve by curve: Legendre polynomials along the abscissa; where the
/// curve runs to and fro, the same again times the direction of loading, so that each branch has its own; where the
/// abscissa is held for long, polynomials in the row. As many as a third of the curve's rows, at most: degree 5, of the
/// direction 3, of a hold 2. Where cycles follow one another, each branch after the first two has shapes of its own as
/// well, all together as many as half of the rows: cycles that differ are no noise.
///
/// A turning point is one that goes back by more than a twentieth of the range: an abscissa that was measured trembles.
Eigen::MatrixXd smooth_columns(const std::vector<Curve>& curves, Eigen::Index rows);

/// The same shapes, without those of single branches, up to any degree, and the degree of each.
struct SmoothShapes {
  Eigen::MatrixXd columns;
  std::vector<double> degree;
};
SmoothShapes smooth_shapes(const std::vector<Curve>& curves, Eigen::Index rows, unsigned most);

/// Direction of loading at each row of an abscissa: 1 up, −1 down, 0 held over four rows or more.
std::vector<int> loading_directions(const std::vector<double>& abscissa);

}  // namespace tunica::diagnosis
