// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/evidence/curves.hpp"

namespace tunica::diagnosis {

/// Smooth shapes a misfit may have: for each curve Legendre polynomials of degree 0, 1, 2 along its rows; and where it
/// runs to and fro, of degree 0, 1 times the direction it runs in. Columns by curve.
struct Shapes {
  Eigen::MatrixXd columns;
  std::vector<std::size_t> curve;  ///< of each column
};
Shapes smooth_shapes(const std::vector<Curve>& curves, Eigen::Index rows);

}  // namespace tunica::diagnosis
