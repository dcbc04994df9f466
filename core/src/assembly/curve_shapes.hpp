// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

namespace tunica::assembly {

/// Columns over the rows of a curve, and the degree of each.
struct CurveShapes {
  Eigen::MatrixXd columns;
  std::vector<double> degree;
};

/// Smooth shapes that whatever is no noise may have: Legendre polynomials along the abscissa up to degree `most`; where
/// the curve runs to and fro, the same again times the direction of loading, so that each branch has its own, to
/// degree `most` − 2; where the abscissa is held for long, polynomials in the row to degree 2. As many as a third of
/// the rows, at most. `each_branch`: where cycles follow one another, each branch after the first two has shapes of its
/// own as well, all together as many as half of the rows: cycles that differ are no noise.
///
/// A turning point is one that goes back by more than a twentieth of the range: an abscissa that was measured trembles.
CurveShapes curve_shapes(const std::vector<double>& abscissa, unsigned most, bool each_branch = false);

/// Direction of loading at each row of an abscissa: 1 up, −1 down, 0 held over four rows or more.
std::vector<int> loading_directions(const std::vector<double>& abscissa);

}  // namespace tunica::assembly
