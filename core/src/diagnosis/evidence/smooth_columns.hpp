// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "assembly/curve_shapes.hpp"
#include "diagnosis/evidence/curves.hpp"

namespace tunica::diagnosis {

/// The shapes of every curve (curve_shapes.hpp), or field (field_shapes.hpp), up to degree 5, those of single branches
/// too, in rows of all.
Eigen::MatrixXd smooth_columns(const std::vector<Curve>& curves, Eigen::Index rows);

/// The same shapes, without those of single branches, up to any degree, and the degree of each.
using SmoothShapes = assembly::CurveShapes;
SmoothShapes smooth_shapes(const std::vector<Curve>& curves, Eigen::Index rows, unsigned most);

using assembly::loading_directions;

}  // namespace tunica::diagnosis
