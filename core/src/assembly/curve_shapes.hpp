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

/// Smooth shapes of any misfit that is not noise. They are Legendre polynomials along the abscissa up to degree `most`.
/// If the curve reverses, the same polynomials times the direction of loading are added up to degree `most` − 2, so
/// each branch has its own. If the abscissa is held for long, polynomials in the row up to degree 2 are added. Their
/// number is at most a third of the number of rows. `each_branch`: in repeated cycles, each branch after the first two
/// also has its own shapes, at most half as many as there are rows in total. Differences between cycles are not noise.
///
/// A turning point is a reversal by more than a twentieth of the range, because a measured abscissa jitters.
CurveShapes curve_shapes(const std::vector<double>& abscissa, unsigned most, bool each_branch = false);

/// Direction of loading at each row of an abscissa: 1 up, −1 down, 0 held over four rows or more.
std::vector<int> loading_directions(const std::vector<double>& abscissa);

}  // namespace tunica::assembly
