// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/smooth_columns.hpp"

#include "assembly/field_shapes.hpp"

namespace tunica::diagnosis {
namespace {

SmoothShapes shapes_of(const std::vector<Curve>& curves, Eigen::Index rows, unsigned most, bool each_branch) {
  std::vector<assembly::CurveShapes> of_curves;
  Eigen::Index count = 0;
  for (const Curve& curve : curves)
    count += of_curves
                 .emplace_back(curve.x.empty() ? assembly::curve_shapes(curve.abscissa, most, each_branch)
                                               : assembly::field_shapes(curve.x, curve.y, curve.abscissa, most))
                 .columns.cols();
  SmoothShapes shapes{Eigen::MatrixXd::Zero(rows, count), {}};
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const auto& [columns, degree] = of_curves[k];
    shapes.columns.block(curves[k].first, at, columns.rows(), columns.cols()) = columns;
    shapes.degree.insert(shapes.degree.end(), degree.begin(), degree.end());
    at += columns.cols();
  }
  return shapes;
}

}  // namespace

SmoothShapes smooth_shapes(const std::vector<Curve>& curves, Eigen::Index rows, unsigned most) {
  return shapes_of(curves, rows, most, false);
}

Eigen::MatrixXd smooth_columns(const std::vector<Curve>& curves, Eigen::Index rows) {
  return shapes_of(curves, rows, 5, true).columns;
}

}  // namespace tunica::diagnosis
