// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/curves.hpp"

#include <utility>

namespace tunica::diagnosis {

std::vector<Curve> curves_of(const assembly::Assembly& assembly, const std::vector<NoiseSource>& noise) {
  std::vector<Curve> curves;
  Eigen::Index at = 0;
  for (const assembly::MeasuredChannel& view : assembly.layout().channels) {
    Curve curve{view.test, view.observable, at, 0, {}, {}, {}, {}, {}};
    const auto *x = view.coordinate("x"), *y = view.coordinate("y");
    for (std::size_t i = 0; i < view.count; ++i)
      if (view.fitted[i]) {
        curve.abscissa.push_back(view.abscissa[i]);
        curve.rows.push_back(i);
        if (!view.is_point(i)) continue;
        curve.x.push_back((*x)[i]);
        curve.y.push_back((*y)[i]);
      }
    if (curve.x.size() != curve.rows.size()) curve.x = curve.y = {};
    curve.count = static_cast<Eigen::Index>(curve.rows.size());
    if (curve.count == 0) continue;
    for (const NoiseSource& source : noise)
      if (source.test == view.test && source.channel == view.observable) curve.noise = source;
    at += curve.count;
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace tunica::diagnosis
