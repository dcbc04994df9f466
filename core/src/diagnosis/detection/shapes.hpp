// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/evidence/curves.hpp"

namespace tunica::diagnosis {

/// Smooth shapes of a misfit. Each curve has Legendre polynomials of degree 0, 1, 2 along its rows. A curve that
/// reverses also has those of degree 0, 1 times the direction of loading. Columns are by curve.
struct Shapes {
  Eigen::MatrixXd columns;
  std::vector<std::size_t> curve;  ///< of each column
};
Shapes smooth_shapes(const std::vector<Curve>& curves, Eigen::Index rows);

}  // namespace tunica::diagnosis
