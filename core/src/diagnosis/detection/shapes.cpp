// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/detection/shapes.hpp"

#include <algorithm>
#include <utility>

namespace tunica::diagnosis {

Shapes smooth_shapes(const std::vector<Curve>& curves, Eigen::Index rows) {
  Shapes shapes;
  std::vector<Eigen::VectorXd> columns;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const Curve& curve = curves[c];
    const auto [low, high] = std::minmax_element(curve.abscissa.begin(), curve.abscissa.end());
    const bool spread = *high > *low;
    std::vector<double> direction(curve.abscissa.size(), 0);
    bool up = false, down = false;
    for (std::size_t i = 0; i < curve.abscissa.size(); ++i) {
      const std::size_t from = i > 0 ? i - 1 : 0, to = i > 0 ? i : std::min<std::size_t>(1, curve.abscissa.size() - 1);
      const double step = curve.abscissa[to] - curve.abscissa[from];
      direction[i] = step > 0 ? 1 : step < 0 ? -1 : i > 0 ? direction[i - 1] : 0;
      up |= step > 0;
      down |= step < 0;
    }
    for (int degree = 0; degree < (up && down ? 5 : 3); ++degree) {
      Eigen::VectorXd column = Eigen::VectorXd::Zero(rows);
      for (Eigen::Index i = 0; i < curve.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double u = spread ? 2 * (curve.abscissa[k] - *low) / (*high - *low) - 1 : 0;
        const double legendre[] = {1, u, 1.5 * u * u - 0.5};
        column[curve.first + i] = degree < 3 ? legendre[degree] : legendre[degree - 3] * direction[k];
      }
      columns.push_back(std::move(column));
      shapes.curve.push_back(c);
    }
  }
  shapes.columns.resize(rows, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) shapes.columns.col(static_cast<Eigen::Index>(k)) = columns[k];
  return shapes;
}

}  // namespace tunica::diagnosis
