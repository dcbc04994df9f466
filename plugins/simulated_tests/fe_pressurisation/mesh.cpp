// SPDX-License-Identifier: Apache-2.0
#include "mesh.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::fe {

Mesh::Mesh(std::size_t order_, std::size_t radial_, std::size_t axial_, double inner_, double outer_,
           double half_length, double grading, Ends ends_, std::span<const double> interfaces)
    : order(order_),
      radial(radial_),
      axial(axial_),
      inner(inner_),
      outer(outer_),
      ends(ends_),
      columns(columns_of(radial_, interfaces)) {
  const auto plane = [&](std::size_t element) {
    const double t = static_cast<double>(element) / static_cast<double>(axial);
    return half_length * (1 - std::pow(1 - t, grading));
  };
  for (std::size_t e = 0; e < axial; ++e)
    for (std::size_t k = 0; k < order; ++k)
      layer.push_back(plane(e) + (plane(e + 1) - plane(e)) * static_cast<double>(k) / static_cast<double>(order));
  layer.push_back(half_length);
  if (interfaces.empty()) return;
  double from = 0;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double to = k < interfaces.size() ? interfaces[k] : 1;
    for (std::size_t e = 0; e < columns[k]; ++e)
      line_.push_back(from + (to - from) * static_cast<double>(e) / static_cast<double>(columns[k]));
    from = to;
  }
  line_.push_back(1);
}

/// One at a time to the layer whose elements are the longest.
std::vector<std::size_t> columns_of(std::size_t radial, std::span<const double> interfaces) {
  std::vector<std::size_t> columns(interfaces.size() + 1, 1);
  const auto length = [&](std::size_t k) {
    const double from = k == 0 ? 0 : interfaces[k - 1], to = k < interfaces.size() ? interfaces[k] : 1;
    return (to - from) / static_cast<double>(columns[k]);
  };
  for (std::size_t given = columns.size(); given < radial; ++given) {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < columns.size(); ++k)
      if (length(k) > length(longest) * (1 + 1e-12)) longest = k;
    ++columns[longest];
  }
  return columns;
}

}  // namespace tunica::fe
