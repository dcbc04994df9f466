// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "assembly/curve_shapes.hpp"

namespace tunica::assembly {

/// Smooth shapes over a measured field: products of Legendre polynomials along x, y and the step,
///
///   P_i(x) P_j(y) P_k(step),  i + j + k ≤ most,  k ≤ 2,
///
/// each over its range. All of one degree d together have the mean square of one polynomial of a curve, 1/(2d + 1), so
/// that what is believed of their sizes holds for both (unlisted_prior.hpp). Neighbours in a field are not neighbours
/// in the file, so that no curve over rows is smooth there. Lowest degrees first, as many as a third of the rows at
/// most.
CurveShapes field_shapes(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& step,
                         unsigned most);

}  // namespace tunica::assembly
