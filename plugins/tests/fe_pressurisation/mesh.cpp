// SPDX-License-Identifier: Apache-2.0
#include "mesh.hpp"

#include <cmath>

namespace tunica::fe {

Mesh::Mesh(std::size_t order_, std::size_t radial_, std::size_t axial_, double inner_, double outer_,
           double half_length, double grading, Ends ends_)
    : order(order_), radial(radial_), axial(axial_), inner(inner_), outer(outer_), ends(ends_) {
  const auto plane = [&](std::size_t element) {
    const double t = static_cast<double>(element) / static_cast<double>(axial);
    return half_length * (1 - std::pow(1 - t, grading));
  };
  for (std::size_t e = 0; e < axial; ++e)
    for (std::size_t k = 0; k < order; ++k)
      layer.push_back(plane(e) + (plane(e + 1) - plane(e)) * static_cast<double>(k) / static_cast<double>(order));
  layer.push_back(half_length);
}

}  // namespace tunica::fe
